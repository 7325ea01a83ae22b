"""Every example runs, gives its number, and the histories that it gave before."""

import runpy
from pathlib import Path

import numpy as np
import psutil
import pytest

from fmu_src.building import ensure_fmus
from railcosim.builds import build_for
from railcosim.cosim import run_system
from railcosim.cosim_options import CosimOptions
from railcosim.irregularity.contact_filter import attenuation
from railcosim.passage import run_passage
from railcosim.passage_package import ensure_package
from railcosim.receptance.points import Place
from railcosim.receptance.study import ReceptanceStudy
from railcosim.result_file import read_netcdf
from railcosim.scenario import Scenario
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise
from vehicle_fmu.contact_patch import patch_semi_axis

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
    """Within 0.1 % of the monolithic solution's peak; docs/verification.md compares all of F(t)."""
    passage = run_passage(read_scenario(EXAMPLES / "varying_track.toml"), fmus="native")
    assert summarise(passage).peak_contact_force == pytest.approx(299.60e3, rel=1e-3)
    # sleepers rise from the ballast, which loses the weight on it and no more
    weight = 9.81 * (125.0 + 60.0 * 0.65)
    assert float(passage["ballast_force"].min()) == pytest.approx(-weight, rel=1e-4)
    assert float(passage["sleeper_displacement"].min()) == pytest.approx(-0.178e-3, rel=0.02)


def test_moving_ballast():
    """Python FMUs give the same to 11 digits; tests/passage holds constant masses to another."""
    passage = run_passage(read_scenario(EXAMPLES / "moving_ballast.toml"), fmus="native")
    assert summarise(passage).peak_contact_force == pytest.approx(232.34e3, rel=1e-3)
    # 114.25 kN without masses
    assert float(passage["ballast_force"].max()) == pytest.approx(109.28e3, rel=2e-3)


def test_uneven_rail(tmp_path):
    """Forces of both wheels, by this implementation; tests/passage holds its parts to others."""
    scenario = read_scenario(EXAMPLES / "uneven_rail.toml")
    force = run_passage(scenario, fmus="native", directory=tmp_path)["contact_force"]
    assert force.max() == pytest.approx(173.35e3, rel=2e-3)
    assert force.min() == pytest.approx(64.23e3, abs=500.0)


def on_both_sides(name):
    """Run a scenario with its contacts on the vehicle, iterated, and on the track, in small steps.

    The second one iterates nothing and has another way of stepping: what both find is no error of
    the coupling.
    """
    path = EXAMPLES / f"{name}.toml"
    small = read_scenario(path, ("master.step=5e-5",))
    return (
        run_passage(read_scenario(path), fmus="native"),
        run_passage(small, fmus="native", contact="track"),
    )


def largest(result, name):
    return float(result[name].max())


def test_worn_wheels():
    """With all nodes and no FMUs all forces are within 0.6 kN (docs/verification.md)."""
    for result in on_both_sides("worn_wheels"):
        assert largest(result, "contact_force") == pytest.approx(263.48e3, rel=5e-4)
        assert float(result["contact_force"].min()) == pytest.approx(27.09e3, abs=50.0)


def test_bridge_transition():
    """The rail bends over the hanging sleepers, the wheels hardly notice."""
    for result in on_both_sides("bridge_transition"):
        assert largest(result, "contact_force") == pytest.approx(105.52e3, rel=1e-3)
        assert largest(result, "bending_moment_under_wheel") == pytest.approx(26.26e3, rel=2e-3)
        sleepers = result["sleeper_displacement"].max("time")
        # embankment, the two that hang by 1 mm, bridge
        found = sleepers.sel(sleeper=[19, 23, 24, 32]).to_numpy()
        assert found == pytest.approx([3.776e-4, 1.3230e-3, 1.3210e-3, 2.140e-4], rel=2e-3)


def test_missing_fastenings():
    """The neighbours of the missing pad carry what it does not."""
    for result in on_both_sides("missing_fastenings"):
        assert largest(result, "contact_force") == pytest.approx(149.9e3, rel=2e-3)
        assert largest(result, "rail_displacement") == pytest.approx(2.5694e-3, rel=1e-3)
        pads = result["pad_force"].sel(sleeper=[24, 25, 26])
        assert pads.max("time").to_numpy() == pytest.approx([91.78e3, 0.0, 88.34e3], abs=150.0)
        # nothing pulls where the clips are gone
        assert float(pads.min()) > -150.0


def test_tram():
    """Rubber in the wheels takes some of the blow of the weld; the braking is that of the table."""
    for result in on_both_sides("tram"):
        force = result["contact_force"]
        assert float(force.max()) == pytest.approx(72.33e3, rel=1e-3)
        assert float(force.min()) == pytest.approx(29.18e3, rel=2e-3)
        # 2.78 m at 13.9 m/s, then 3.72 m = 13.9 t - t^2
        assert float(result["time"][-1]) == pytest.approx(0.2 + 6.95 - (6.95**2 - 3.72) ** 0.5)
    solid = read_scenario(EXAMPLES / "tram.toml", ("suspension.tread_mass=0",))
    passage = run_passage(solid, fmus="native", contact="track")
    assert largest(passage, "contact_force") == pytest.approx(73.3e3, rel=2e-3)


def test_corrugation():
    """Its force is that of the linear theory of a roughness between wheel, contact and track."""
    scenario = read_scenario(EXAMPLES / "corrugation.toml")
    load, frequency = scenario.vehicle.static_wheel_load, scenario.vehicle.constant_speed / 0.05
    omega = 2.0 * np.pi * frequency
    patch = patch_semi_axis(force=load, wheel_radius=0.45, rail_radius=0.3)
    roughness = 20e-6 * attenuation(np.array([2.0 * np.pi / 0.05]), patch)[0]
    contact = 1.5 * scenario.vehicle.hertz_coefficient ** (2 / 3) * load ** (1 / 3)

    def force_at(position):
        place = Place(position=position)
        study = ReceptanceStudy(scenario=scenario, load=place, response=place, preload=load)
        track = study.receptance(np.array([frequency]))[0]
        return roughness / (track + 1.0 / contact - 1.0 / (scenario.vehicle.wheel_mass * omega**2))

    bay = 16.25 + 0.65 * (np.arange(8) + 0.5) / 8
    expected = abs(np.mean([force_at(position) for position in bay]))
    assert expected == pytest.approx(5961.0, rel=1e-3)
    for result in on_both_sides("corrugation"):
        along = result["wheel_position"].sel(wheel=1)
        whole_bays = np.interp((14.3, 18.2), along, result["time"])
        time = np.linspace(*whole_bays, 20_001)
        force = np.interp(time, result["time"], result["contact_force"].sel(wheel=1))
        line = 2.0 * np.mean((force - force.mean()) * np.exp(-1j * omega * time))
        assert abs(line) == pytest.approx(expected, rel=0.01)


def test_dipped_joint():
    """The stroke of contact and wheel at 0.2 ms, that of wheel and track some 3 ms later."""
    for result in on_both_sides("dipped_joint"):
        time = result["time"] - np.interp(0.0, result["distance"], result["time"])
        force = result["contact_force"].sel(wheel=1).to_numpy()
        assert force[(time > 0.0) & (time < 1e-3)].max() == pytest.approx(271.03e3, rel=2e-3)
        assert force.max() == pytest.approx(295.06e3, rel=5e-4)
        assert 3e-3 < float(time[force.argmax()]) < 4.5e-3
        assert summarise(result).loss_of_contact_time == pytest.approx(5.507e-3, rel=3e-3)


def test_power_car():
    """The contact on the vehicle gives 118.25 kN, 67.51 kN and 97.63 kN on the primary spring."""
    scenario = read_scenario(EXAMPLES / "power_car.toml", ("master.step=5e-5",))
    result = run_passage(scenario, fmus="native", contact="track")
    assert largest(result, "contact_force") == pytest.approx(118.25e3, rel=1e-3)
    assert float(result["contact_force"].min()) == pytest.approx(67.51e3, rel=1e-3)
    assert largest(result, "primary_force") == pytest.approx(97.631e3, rel=1e-3)
    free = ("master.step=5e-5", "suspension.primary_stop_stiffness=0")
    soft = run_passage(
        read_scenario(EXAMPLES / "power_car.toml", free), fmus="native", contact="track"
    )
    assert largest(soft, "primary_force") == pytest.approx(96.620e3, rel=1e-3)


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
    assert float(passage["bogie_acceleration"].max()) == pytest.approx(0.3833, rel=5e-3)
    # the strike of 18 kN for some milliseconds, on 44 t: the car body does not feel it
    assert float(abs(passage["car_acceleration"]).max()) < 0.005


def test_endless_supports(tmp_path):
    """By this implementation; tests/passage holds such supports to those of an ordinary track."""
    scenario = read_scenario(EXAMPLES / "endless_supports.toml")
    result = run_passage(scenario, fmus="native", contact="track", directory=tmp_path)
    deepest = result["sleeper_displacement"].max("time")
    assert float(deepest.max()) == pytest.approx(0.8535e-3, rel=2e-3)
    assert float(result["sleeper_position"][int(deepest.argmax("sleeper"))]) == pytest.approx(
        112 * 0.65
    )
    assert float(result["contact_force"].max()) == pytest.approx(124.80e3, rel=1e-3)
    # nothing rests on the sleeper without a pad
    missing = np.abs(result["sleeper_position"] - 92 * 0.65) < 0.1
    assert float(deepest[missing].max()) < 0.01e-3


def test_the_first_of_ten_kilometres():
    """318.76 kN at half the step; the force that is kept has the static mean."""
    scenario = read_scenario(EXAMPLES / "kilometres.toml", ["run.departure=116.1"])
    result = run_passage(scenario, fmus="native", contact="track")
    summary = summarise(result)
    assert summary.whole_run.largest_contact_force == pytest.approx(318.73e3, rel=1e-3)
    assert summary.peak_contact_force == pytest.approx(241.64e3, rel=1e-3)
    assert summary.unreliable == []
    assert result.sizes["time"] == 1201
    mean = result["contact_force"].mean("time")
    static = float(result["static_wheel_load"])
    assert np.abs(mean - static).max() < 0.01 * static


@pytest.mark.slow
def test_ten_kilometres(tmp_path):
    """As much memory and time a metre at the end as at the beginning."""
    output, process = tmp_path / "kilometres.nc", psutil.Process()
    points = []

    def watch(progress):
        if progress.time >= len(points):  # once a second, which are 56 m
            points.append((process.cpu_times().user, process.memory_info().rss / 1e6))

    run_passage(
        read_scenario(EXAMPLES / "kilometres.toml"),
        fmus="native",
        contact="track",
        histories=output,
        report=watch,
    )
    used, memory = np.array(points[1:]).T
    settled = memory[len(memory) // 4 :]  # 16 MB of the step log stay in memory, then none
    assert settled.max() - settled.min() < 20.0
    cost = np.diff(used)
    quarter = len(cost) // 4
    # other programs on the machine leave a tenth of doubt
    assert np.median(cost[-quarter:]) == pytest.approx(np.median(cost[:quarter]), rel=0.15)
    result = read_netcdf(output, "")
    assert result.sizes["time"] == 100_001
    assert result["distance"][-1] == pytest.approx(9996.1)
    assert result["contact_force_largest"].sizes["stretch"] == 101
    # the flat strikes in every stretch
    assert result["contact_force_largest"].sel(wheel=1).min() > 250e3


def test_sleepers(tmp_path):
    """Within a fifth of a percent of the whole track without modes (`railcosim.monolithic`)."""
    scenario = read_scenario(EXAMPLES / "sleepers.toml")
    result = run_passage(scenario, fmus="native", directory=tmp_path)
    summary = summarise(result)
    assert summary.peak_contact_force == pytest.approx(229.38e3, rel=2e-3)
    assert summary.max_sleeper_displacement == pytest.approx(0.5401e-3, rel=2e-3)
    assert float(result["sleeper_bending_moment"].max()) == pytest.approx(12.866e3, rel=2e-3)
    assert float(result["sleeper_centre_bending_moment"].min()) == pytest.approx(-5.184e3, rel=2e-3)
