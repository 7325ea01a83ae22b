"""The cache of modal bases is never stale and never trusts a damaged file."""

import numpy as np
import pytest

from fmu_src.python.basis_cache import basis_key, cached_basis
from track_fmu.assembly import assemble
from track_fmu.parameters import TrackParameters

SMALL = TrackParameters(bays=6, elements_per_bay=2)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path))
    return tmp_path / "modal"


def test_what_was_computed_once_is_read_back(folder):
    matrices = assemble(SMALL)
    first = cached_basis(SMALL, matrices, mode_pairs=8)
    [file] = folder.iterdir()
    written = file.stat().st_mtime_ns
    again = cached_basis(SMALL, matrices, mode_pairs=8)
    assert again.modes.tobytes() == first.modes.tobytes()
    assert file.stat().st_mtime_ns == written


def test_every_parameter_is_part_of_the_key():
    keys = {basis_key(SMALL, 8), basis_key(SMALL, 9)}
    keys.add(basis_key(TrackParameters(bays=6, elements_per_bay=2, pad_damping=15000.000001), 8))
    assert len(keys) == 3


def test_any_damage_is_noticed(folder):
    matrices = assemble(SMALL)
    sound = cached_basis(SMALL, matrices, mode_pairs=8)
    [file] = folder.iterdir()
    data = file.read_bytes()
    random = np.random.default_rng(5)
    damages = [b"", data[:10], data[:-1], data + b"x", b"\x93NUMPY" + data]
    damages += [
        data[:place] + bytes([data[place] ^ 4]) + data[place + 1 :]
        for place in random.integers(0, len(data), 60)
    ]
    for damaged in damages:
        file.write_bytes(damaged)
        assert cached_basis(SMALL, matrices, mode_pairs=8).modes.tobytes() == sound.modes.tobytes()
        assert file.read_bytes() == data


def test_a_cache_that_cannot_be_written_does_not_matter(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path / "file"))
    assert len(cached_basis(SMALL, assemble(SMALL), mode_pairs=8).eigenvalues) == 8
