"""Random calls and damaged files under sanitizers: `make fuzz` makes more of them.

FUZZ_CALLS and FUZZ_SEEDS say how many and from where. A failure names the seed and the call.
"""

import logging
import os
from dataclasses import replace

import pytest

from fmu_src.native.model_resources import track_resource
from fmu_src.native.model_sources import MODELS

from . import sanitised

LOG = logging.getLogger(__name__)
CALLS = int(os.environ.get("FUZZ_CALLS", "20000"))
SEEDS = [int(seed) for seed in os.environ.get("FUZZ_SEEDS", "1").split()]
TIME_LIMIT = 60 + CALLS / 500  # s
TOKEN = "token"  # noqa: S105 - no secret, but the identity of a build
KINDS = ["2", "3", "resources"]
"""Functions of these versions of FMI, or damaged resources."""


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sanitised")
    return sanitised.build(folder, sorted(MODELS), sanitised.compiler())


def put(folder, data, token=TOKEN):
    folder.mkdir(parents=True)
    (folder / "build.txt").write_text(f"{token}\n")
    if data is not None:
        (folder / "model.bin").write_bytes(data)


@pytest.fixture
def folders(tmp_path, resources):
    """Return a function that makes the resources of a model or of given bytes, and wrong ones."""

    def make(model):
        data = model if isinstance(model, bytes) else resources[model]
        damaged = bytearray(data)
        damaged[len(data) // 2] ^= 1
        put(tmp_path / "good", data)
        put(tmp_path / "wrong/damaged", damaged)
        put(tmp_path / "wrong/truncated", data[:-9])
        put(tmp_path / "wrong/folder", None)
        (tmp_path / "wrong/folder/model.bin").mkdir()
        (tmp_path / "wrong/empty").mkdir()
        put(tmp_path / "wrong/other", data, token="another")  # noqa: S106 - as above
        return tmp_path / "good", TOKEN, tmp_path / "wrong"

    return make


@pytest.fixture(scope="module")
def bent(short_track):
    """Resource of a track on sleepers that bend."""
    parameters = replace(short_track, sleeper="beam", sleeper_elements=3)
    return track_resource(parameters, wheels=2, gauges=2, mode_pairs=40, contact=True)


def check(program, kind, places):
    calls = CALLS if kind != "resources" else max(500, CALLS // 50)
    for seed in SEEDS:
        counted = sanitised.fuzz(program, kind, seed, calls, *places, timeout=TIME_LIMIT)
        LOG.info("%s %s, seed %d: %s", program.name, kind, seed, counted)
        numbers = [int(word) for word in counted.split() if word.isdigit()]
        assert numbers[0] >= calls
        assert all(number > calls // 50 for number in numbers)  # every answer was met


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("model", MODELS)
def test_under_the_best_sanitizers(programs, folders, model, kind):
    check(programs[model], kind, folders(model))


@pytest.mark.parametrize("kind", KINDS)
def test_sleepers_that_bend(programs, folders, bent, kind):
    check(programs["track_contact"], kind, folders(bent))


def test_damaged_tables(tmp_path):
    """Supports, rail pads and curves, read from thousands of files by the readers of them all."""
    program = sanitised.build_readers(tmp_path, sanitised.compiler())
    for seed in SEEDS:
        counted = sanitised.fuzz(
            program, seed, CALLS // 4, tmp_path / "one.csv", timeout=TIME_LIMIT
        )
        LOG.info("tables, seed %d: %s", seed, counted)
        assert all(int(word) > CALLS // 40 for word in counted.split() if word.isdigit())


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_under_the_sanitizer_that_is_always_there(tmp_path, folders, model):
    programs = sanitised.build(tmp_path, [model], "zig")
    places = folders(model)
    for kind in KINDS:
        check(programs[model], kind, places)
