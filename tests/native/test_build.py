"""Native FMUs are built once, the same every time, and refused in words."""

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from fmu_src.building import ensure_native_fmus
from fmu_src.native import compiler
from fmu_src.native.compiler import TARGETS, CompilationError, this_target
from fmu_src.native.library_cache import cached_library
from fmu_src.native.models import native_vehicle
from fmu_src.native.packaging import fmu_contents
from fmu_src.python.track_parameters import SPEED
from fmu_src.python.track_variables import STATIC_WHEEL_LOAD
from track_fmu.ballast import PolynomialBallast
from track_fmu.parameters import TrackParameters
from track_fmu.track_model import TrackModel, TrackOptions

from .twins import reduced_track


def test_what_is_there_is_left_alone_and_what_is_damaged_built_again(tmp_path, small):
    built = []
    first = ensure_native_fmus(tmp_path, small, progress=built.append)
    assert f"building {first.vehicle.name}" in built  # followed by what is compiled, if anything
    before = first.track.read_bytes()
    built.clear()
    ensure_native_fmus(tmp_path, small, progress=built.append)
    assert built == []
    first.track.write_bytes(before[:-1000])
    ensure_native_fmus(tmp_path, small, progress=built.append)
    assert built == [f"building {first.track.name}"]
    assert first.track.read_bytes() == before


def test_another_basis_is_another_file_and_few_are_kept(tmp_path, small):
    usual = ensure_native_fmus(tmp_path, small)
    files = [
        ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": value}).track
        for value in (1e8, 1.1e8)
    ]
    assert len({usual.track, *files}) == 3
    start = {v.name: v.start for v in fmpy.read_model_description(files[1]).modelVariables}
    assert float(start["pad_stiffness"]) == 1.1e8
    for place in range(9):
        (tmp_path / f"{usual.track.stem}-basis-{place:012x}.fmu").write_bytes(b"")
    newest = ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": 1.2e8}).track
    kept = list(tmp_path.glob("Track*-basis-*.fmu"))
    assert len(kept) == 8
    assert newest in kept
    assert usual.track.exists()


@pytest.mark.parametrize(("version", "contact"), [(2, "vehicle"), (3, "track")])
def test_a_track_on_bending_sleepers_keeps_to_the_standard(tmp_path, small, version, contact):
    """And says so in its constants, and has the moments that the numpy model has at the start."""
    fixed = {"sleeper": "beam", "sleeper_elements": 3, "mode_pairs": 60}
    path = ensure_native_fmus(
        tmp_path, small, fixed=fixed, fmi_version=version, contact=contact
    ).track
    assert validate_fmu(str(path)) == []
    variables = {v.name: v for v in fmpy.read_model_description(path).modelVariables}
    assert (variables["sleeper"].start, variables["sleeper"].variability) == ("beam", "constant")
    parameters = TrackParameters(
        bays=small.bays, elements_per_bay=small.elements_per_bay, sleeper="beam", sleeper_elements=3
    )
    options, law = TrackOptions(initial_speed=SPEED), PolynomialBallast()
    track = TrackModel(reduced_track(parameters, 60), options, ballast=law)
    start = [float(variables[f"wheel[{k}].position"].start) for k in (1, 2)]
    track.start(np.array(start), np.full(2, STATIC_WHEEL_LOAD))
    at_seat, at_centre = track.observe().sleeper_moment, track.observe().sleeper_centre_moment
    most = int(np.argmax(at_seat))
    assert min(at_seat[most], -at_centre[most]) > 5e2
    outputs = [f"sleeper[{most + 1}].{n}" for n in ("bending_moment", "centre_bending_moment")]
    result = fmpy.simulate_fmu(str(path), stop_time=1e-4, step_size=1e-4, output=outputs)
    expected = [at_seat[most], at_centre[most]]
    assert [result[name][0] for name in outputs] == pytest.approx(expected, rel=1e-9)


def test_what_no_track_can_have_is_refused(tmp_path, small):
    with pytest.raises(ValueError, match="ballast_alpha is not fixed in a native track"):
        ensure_native_fmus(tmp_path, small, fixed={"ballast_alpha": 1.0})
    with pytest.raises(ValueError, match="pad_stiffness"):
        ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": -1.0})


def contents(monkeypatch, cache, model, version):
    """Everything in an FMU, made with a cache of its own."""
    monkeypatch.setenv("RAILCOSIM_CACHE", str(cache))
    return fmu_contents(model, fmi_version=version, platforms=[this_target()])


@pytest.mark.parametrize("version", [2, 3])
def test_the_same_bytes_with_and_without_a_cache(tmp_path, monkeypatch, version):
    model = native_vehicle(wheels=2)
    first = contents(monkeypatch, tmp_path, model, version)
    for other in (tmp_path, tmp_path / "fresh"):
        assert contents(monkeypatch, other, model, version) == first


def test_a_damaged_library_in_the_cache_is_compiled_again(tmp_path, monkeypatch):
    monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path))
    said = []
    first = cached_library("vehicle", this_target(), name="Vehicle", notify=said.append)
    (stored,) = (tmp_path / "native").iterdir()
    stored.write_bytes(stored.read_bytes()[:-1])
    again = cached_library("vehicle", this_target(), name="Vehicle", notify=said.append)
    cached_library("vehicle", this_target(), name="Vehicle", notify=said.append)
    assert again == first
    assert said == [f"compiling Vehicle for {this_target()}"] * 2


def test_without_a_compiler_one_sentence_says_what_to_install(tmp_path, monkeypatch, small):
    monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path))
    monkeypatch.setattr(compiler, "find_spec", lambda _: None)
    with pytest.raises(CompilationError, match=r"^the C compiler is missing: install the package"):
        ensure_native_fmus(tmp_path, small)


@pytest.mark.slow
@pytest.mark.parametrize("version", [2, 3])
def test_archives_for_every_platform_are_reproducible(tmp_path, small, version, monkeypatch):
    archives = []
    for name in ("one", "other"):
        monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path / name))
        pair = ensure_native_fmus(tmp_path / name, small, fmi_version=version, platforms=TARGETS)
        archives.append([path.read_bytes() for path in (pair.track, pair.vehicle)])
        for path in (pair.track, pair.vehicle):
            assert validate_fmu(str(path)) == []
    assert archives[0] == archives[1]
