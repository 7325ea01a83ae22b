"""Every example runs and gives its number."""

import runpy
from pathlib import Path

import pytest

from build_fmus import ensure_fmus

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


@pytest.fixture(scope="module")
def paths(tmp_path_factory):
    fmus = ensure_fmus(tmp_path_factory.mktemp("fmus"))
    return str(fmus.track), str(fmus.vehicle)


def test_single_fmus(paths):
    example = runpy.run_path(str(EXAMPLES / "single_fmus.py"))
    # 1.13 to 1.15 mm under static wheel loads, by the full finite element model
    assert example["track_under_moving_forces"](paths[0]) == pytest.approx(1.148e-3, abs=2e-6)
    # m a of the sag is 4.7 kN; what its sudden start sets off adds to the static load too
    force = example["vehicle_on_prescribed_rail"](paths[1])
    assert 117.72e3 + 4.7e3 < force < 117.72e3 + 4 * 4.7e3


def test_hand_written_loop(paths):
    """Within 0.2 % of the peak of the full finite element model, 234.31 kN."""
    example = runpy.run_path(str(EXAMPLES / "hand_written_loop.py"))
    assert example["passage"](*paths) == pytest.approx(234.31e3, rel=2e-3)


def test_contact_on_track(tmp_path):
    """The same, at four times the step."""
    fmus = ensure_fmus(tmp_path, contact="track")
    example = runpy.run_path(str(EXAMPLES / "contact_on_track.py"))
    peak = example["passage"](str(fmus.track), str(fmus.vehicle))
    assert peak == pytest.approx(234.31e3, rel=2e-3)
