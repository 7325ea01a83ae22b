"""Every example runs, gives its number, and the histories that it gave before."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from build_fmus import ensure_fmus
from railcosim.builds import build_for
from railcosim.cosim import run_system
from railcosim.cosim_options import CosimOptions
from railcosim.passage import run_passage
from railcosim.passage_package import ensure_package
from railcosim.scenario import Scenario
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
TOLERANCES = EXAMPLES / "baselines" / "tolerances.toml"
SHORT = 0.4  # s; the flat meets the rail at 0.351 s


@pytest.fixture(scope="module")
def paths(tmp_path_factory):
    fmus = ensure_fmus(tmp_path_factory.mktemp("fmus"))
    return str(fmus.track), str(fmus.vehicle)


@pytest.fixture
def baseline_folder():
    return EXAMPLES / "baselines"


def coarse(rows, every):
    """Every so manieth row as fmpy gives a result."""
    names = ("time", "wheel[1].contact_force", "wheel[2].contact_force")
    return np.array(rows, dtype=[(name, float) for name in names])[::every]


def test_single_fmus(paths, baseline):
    example = runpy.run_path(str(EXAMPLES / "single_fmus.py"))
    track = example["track_under_moving_forces"](paths[0])
    # 1.13 to 1.15 mm under static wheel loads, by the full finite element model
    assert track["wheel[1].rail_displacement"].max() == pytest.approx(1.148e-3, abs=2e-6)
    vehicle = example["vehicle_on_prescribed_rail"](paths[1])
    # m a of the sag is 4.7 kN; what its sudden start sets off adds to the static load too
    force = vehicle["wheel[1].contact_force"].max()
    assert 117.72e3 + 4.7e3 < force < 117.72e3 + 4 * 4.7e3
    baseline.check(track, TOLERANCES, name="track_under_moving_forces")
    baseline.check(vehicle, TOLERANCES, name="vehicle_on_prescribed_rail")


def test_hand_written_loop(paths, baseline):
    """Within 0.2 % of the peak of the full finite element model, 234.31 kN."""
    example = runpy.run_path(str(EXAMPLES / "hand_written_loop.py"))
    rows = example["passage"](*paths)
    assert max(row[1] for row in rows) == pytest.approx(234.31e3, rel=2e-3)
    baseline.check(coarse(rows, 16), TOLERANCES, name="hand_written_loop")


def test_contact_on_track(tmp_path, baseline):
    """The same, at four times the step."""
    fmus = ensure_fmus(tmp_path, contact="track")
    example = runpy.run_path(str(EXAMPLES / "contact_on_track.py"))
    rows = example["passage"](str(fmus.track), str(fmus.vehicle))
    assert max(row[1] for row in rows) == pytest.approx(234.31e3, rel=2e-3)
    baseline.check(coarse(rows, 4), TOLERANCES, name="contact_on_track")


def test_varying_track():
    """Python FMUs give the same to 13 digits; no other program has this track."""
    passage = run_passage(read_scenario(EXAMPLES / "varying_track.toml"), fmus="native")
    assert summarise(passage).peak_contact_force == pytest.approx(299.09e3, rel=1e-3)


def test_moving_ballast():
    """Python FMUs give the same to 11 digits; tests/passage holds constant masses to another."""
    passage = run_passage(read_scenario(EXAMPLES / "moving_ballast.toml"), fmus="native")
    assert summarise(passage).peak_contact_force == pytest.approx(232.34e3, rel=1e-3)
    # 114.25 kN without masses
    assert float(passage["ballast_force"].max()) == pytest.approx(109.28e3, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "peak", "smallest"),
    [("uneven_rail", 173.35e3, 64.23e3), ("worn_wheels", 272.26e3, 27.03e3)],
)
def test_uneven_surfaces(tmp_path, name, peak, smallest):
    """Forces of both wheels, by this implementation; tests/passage holds its parts to others."""
    scenario = read_scenario(EXAMPLES / f"{name}.toml")
    force = run_passage(scenario, fmus="native", directory=tmp_path)["contact_force"]
    assert force.max() == pytest.approx(peak, rel=2e-3)
    assert force.min() == pytest.approx(smallest, abs=500.0)


def test_passage_as_a_system(tmp_path, baseline):
    """Native FMUs, whose results are those of the Python ones, up to 50 ms after the strike."""
    fmus = build_for(Scenario(), "native", directory=tmp_path)
    package = tmp_path / "Passage.ssp"
    ensure_package(Scenario(), fmus, package)
    result = run_system(package, CosimOptions(stop_time=SHORT))
    even = result[["vehicle.wheel[1].contact_force", "track.sleeper[28].displacement"]].interp(
        time=np.linspace(0.0, SHORT, 1001)
    )
    baseline.check(even.drop_attrs(deep=False), TOLERANCES, name="passage_as_a_system")


def test_coach():
    """A flat under a coach: 94.71 kN at 25 us with contact on the vehicle, and on the track."""
    passage = run_passage(read_scenario(EXAMPLES / "coach.toml"), fmus="native")
    assert float(passage["contact_force"].max()) == pytest.approx(94.71e3, rel=1e-3)
    assert float(passage["bogie_acceleration"].max()) == pytest.approx(0.380, rel=5e-3)
    # the strike of 18 kN for some milliseconds, on 44 t: the car body does not feel it
    assert float(abs(passage["car_acceleration"]).max()) < 0.005


def test_sleepers(tmp_path):
    """Within a fifth of a percent of the whole track without modes (`railcosim.monolithic`)."""
    scenario = read_scenario(EXAMPLES / "sleepers.toml")
    result = run_passage(scenario, fmus="native", directory=tmp_path)
    summary = summarise(result)
    assert summary.peak_contact_force == pytest.approx(229.38e3, rel=2e-3)
    assert summary.max_sleeper_displacement == pytest.approx(0.5401e-3, rel=2e-3)
    assert float(result["sleeper_bending_moment"].max()) == pytest.approx(12.866e3, rel=2e-3)
    assert float(result["sleeper_centre_bending_moment"].min()) == pytest.approx(-5.184e3, rel=2e-3)
