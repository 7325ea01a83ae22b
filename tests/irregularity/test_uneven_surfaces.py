"""What the tables of a scenario add up to, and the files that the FMUs read."""

import dataclasses

import numpy as np
import pytest

from fmu_src.python.tables import read_table
from railcosim.errors import InputError, RunError
from railcosim.irregularity.contact_filter import attenuation
from railcosim.irregularity.windows import onset
from railcosim.rail_sections import Corrugation, FraTrack, Iso3095Roughness, Joint, MeasuredRail
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run, Surface
from railcosim.surfaces.dataset import surface_dataset
from railcosim.surfaces.files import files_of
from railcosim.surfaces.rail import compose_rail, semi_axis
from railcosim.surfaces.tables import compose, written
from railcosim.surfaces.wheels import compose_treads
from railcosim.vehicle_section import Vehicle
from railcosim.wheel_sections import MeasuredWheel, Polygon, Spall, WheelFlat

START, END = 12.7, 19.2  # of the leading wheel


def fail():
    raise RunError("it failed")


def case(*irregularity, wheel_defect=(), **sections):
    return Scenario(irregularity=irregularity, wheel_defect=wheel_defect, **sections)


@pytest.fixture
def table(tmp_path):
    def table(name, x, y):
        path = tmp_path / name
        np.savetxt(path, np.column_stack([x, y]))
        return str(path)

    return table


def test_nothing_is_nothing():
    surfaces = compose(Scenario())
    assert surfaces.are_smooth
    assert compose_treads(Scenario()) == ()


def test_the_rail_sets_in_behind_the_start_of_the_leading_wheel():
    wave = Corrugation(wavelength=0.3, depth=2e-4, phase_deg=90.0)
    rail = compose_rail(case(wave, surface=Surface(ramp=0.8)))
    x, drop = rail.position, rail.drop
    assert x[0] == pytest.approx(START, rel=1e-15)
    assert x[-1] >= END
    whole = 1e-4 * np.cos(2 * np.pi * x / 0.3)
    assert drop == pytest.approx((whole - whole[0]) * onset(x - START, 0.8), abs=1e-15)
    # so that force and acceleration do not jump
    assert abs(np.diff(drop)[:3]).max() < 1e-3 * abs(np.diff(drop)).max()


def test_irregularities_add_up():
    parts = (Corrugation(begin=14.0, end=15.0), Joint(position=17.0, length=0.5), FraTrack(seed=3))
    together = compose_rail(case(*parts))
    curves = [compose_rail(case(part)).curve() for part in parts]
    expected = [sum(curve(x) for curve in curves) for x in together.position.tolist()]
    # curves through coarser tables of their own: 20 points in the shortest wave of the track
    assert together.drop == pytest.approx(np.array(expected), abs=3e-6)


def test_a_longer_approach_is_the_same_rail_seen_earlier():
    rough = Iso3095Roughness(seed=6, shortest_wavelength=0.02)
    surface = Surface(ramp=0.0)
    near = compose_rail(case(rough, surface=surface, run=Run(approach=1.0)))
    far = compose_rail(case(rough, surface=surface, run=Run(approach=3.0)))
    x = np.linspace(16.0, 18.0, 301)
    change = [far.curve()(p) - near.curve()(p) for p in x.tolist()]
    # but for a constant, and for where the points of the curves lie
    assert np.ptp(change) < 0.05 * np.ptp(near.drop)


def test_a_measured_rail_is_scaled_and_never_taken_more_coarsely(table):
    x = np.arange(10.0, 25.0, 0.004)
    heights = 30.0 * np.sin(2 * np.pi * x / 0.013)  # micrometres, upwards; 3 points a wave
    rail = compose_rail(case(MeasuredRail(file=table("rail.csv", x, heights), scale=-1e-6)))
    assert np.diff(rail.position).max() <= 0.004 * (1 + 1e-9)
    assert np.ptp(rail.drop) == pytest.approx(60e-6, rel=0.05)


def test_the_contact_filter_weakens_short_waves():
    wave = Corrugation(wavelength=0.03, depth=4e-5)
    bare, filtered = (
        compose_rail(case(wave, surface=Surface(ramp=0.1, contact_filter=wanted)))
        for wanted in (False, True)
    )
    factor = attenuation(np.array([2 * np.pi / 0.03]), semi_axis(Scenario()))[0]
    assert 0.4 < factor < 0.9
    inner = (bare.position > 14.0) & (bare.position < 19.0)
    assert np.ptp(filtered.drop[inner]) == pytest.approx(
        factor * np.ptp(bare.drop[inner]), rel=2e-3
    )


def test_a_rail_of_too_many_points_is_refused():
    fine = Corrugation(wavelength=1e-5)
    with pytest.raises(InputError, match="at most 2000000 can be used: leave the shortest waves"):
        compose_rail(case(fine))


def test_waves_of_too_many_lengths_are_refused():
    with pytest.raises(InputError, match=r"waves from 0\.003 to 100 m take 33554432 points"):
        compose_rail(case(FraTrack(shortest_wavelength=0.003)))


def test_treads_add_up_wheel_by_wheel(table):
    angle = np.arange(90) * 2 * np.pi / 90
    measured = MeasuredWheel(file=table("wheel.csv", angle, np.sin(angle)), scale=1e-4, wheel=2)
    defects = (
        Polygon(order=20, amplitude=2e-5, phase_deg=90.0, wheel=2),
        measured,
        Spall(wheel=2, angle_deg=180.0, rolled=False),
    )
    first, second = compose_treads(case(wheel_defect=defects))
    assert first is None
    a = second.angle
    # the spall is not at these angles; the curve through 90 points is good to 6e-4 of its sine
    away = abs(a - np.pi) > 0.1
    expected = -2e-5 * np.sin(20 * a) + 1e-4 * np.sin(a)
    assert second.drop[away] == pytest.approx(expected[away], abs=1e-7)
    assert second.drop.max() == pytest.approx(1e-3, abs=2e-7)


def test_the_contact_filter_leaves_flats_as_they_are():
    surface = Surface(contact_filter=True)
    flat, waves = WheelFlat(length=0.02), Polygon(order=120, amplitude=1e-5)
    both = compose_treads(case(wheel_defect=(flat, waves), surface=surface))[0]
    alone = compose_treads(case(wheel_defect=(flat,), surface=surface))[0]
    # on the same angles only where the flat's points are the closest
    assert alone.drop.max() == 0.9e-3
    rest = np.abs(both.angle - np.pi) < 1.0
    factor = attenuation(np.array([120 / 0.45]), semi_axis(Scenario()))[0]
    assert both.drop[rest].max() == pytest.approx(factor * 1e-5, rel=1e-3)


def test_a_dent_that_does_not_fit_is_refused():
    with pytest.raises(InputError, match="wheel_defect of wheel 2: the flat acts over 4 m"):
        compose_treads(case(wheel_defect=(WheelFlat(wheel=2, length=4.0),)))


def test_files_hold_the_tables_bit_for_bit_and_go_with_the_run():
    scenario = case(Joint(position=16.0), wheel_defect=(Polygon(order=9, amplitude=1e-5, wheel=2),))
    surfaces = compose(scenario)
    with written(scenario, surfaces) as files:
        rail = read_table(files.rail, ("position", "drop"))
        assert files.treads[0] == ""
        tread = read_table(files.treads[1], ("angle", "drop"))
    assert rail["position"].tobytes() == surfaces.rail.position.tobytes()
    assert rail["drop"].tobytes() == surfaces.rail.drop.tobytes()
    assert tread["drop"].tobytes() == surfaces.treads[1].drop.tobytes()
    with pytest.raises(ValueError, match="cannot be read"):
        read_table(files.rail, ("position", "drop"))


@pytest.mark.parametrize("fails", [True, False])
def test_files_stay_beside_a_replay_file_if_the_run_fails(tmp_path, fails):
    scenario = case(Joint(position=16.0))
    replay = tmp_path / "run.replay"
    try:
        with written(scenario, compose(scenario), replay=replay) as files:
            assert files.rail == str(tmp_path / "run.tables" / "rail.csv")
            if fails:
                replay.touch()
                fail()
    except RunError:
        assert (tmp_path / "run.tables" / "rail.csv").is_file()
    else:
        assert list(tmp_path.iterdir()) == []


def test_no_files_stay_where_a_run_fails_before_it_has_a_replay_file(tmp_path):
    scenario = case(Joint(position=16.0))
    with (
        pytest.raises(RunError),
        written(scenario, compose(scenario), replay=tmp_path / "run.replay"),
    ):
        fail()
    assert list(tmp_path.iterdir()) == []


def test_a_rail_that_is_a_file_is_used_as_it_is(table):
    path = table("rail.csv", [10.0, 12.0, 15.0, 20.0], [0.0, 1e-3, 0.0, 1e-3])
    scenario = Scenario(
        vehicle=Vehicle(rail_irregularity=path), wheel_defect=(Spall(),), flat=Flat(shape="none")
    )
    surfaces = compose(scenario)
    assert surfaces.rail.drop.tolist() == [0.0, 1e-3, 0.0, 1e-3]
    with written(scenario, surfaces) as files:
        assert files.rail == path
        assert files.treads[1] == ""


def test_a_package_has_no_place_for_composed_tables():
    assert files_of(Scenario()).treads == ("", "")
    with pytest.raises(InputError, match="no part of a package"):
        files_of(case(Joint(position=16.0)))


def test_the_result_says_what_was_rolled_over():
    scenario = case(Joint(position=16.0), wheel_defect=(Spall(wheel=2),))
    surfaces = compose(scenario)
    data = surface_dataset(surfaces)
    assert data["rail_drop"].to_numpy().tobytes() == surfaces.rail.drop.tobytes()
    assert data["tread_drop"].dims == ("wheel", "tread_angle")
    assert not data["tread_drop"][0].any()
    assert all({"units", "long_name", "sign"} <= set(v.attrs) for v in data.variables.values())
    smooth = surface_dataset(dataclasses.replace(surfaces, rail=None, treads=()))
    assert len(smooth.variables) == 0
