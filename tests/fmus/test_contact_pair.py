"""TrackContact and Masses as a host sees them that neither iterates nor rolls back."""

import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

from fmu_src.building import ensure_fmus
from fmu_src.structure import Structure
from orchestrator import check_fmu

from .instance import Instance

SPEED = 40.0 / 3.6
STATIC_LOAD = 117_720.0
SMALL = {"mode_pairs": 40, "wheel[1].position": 3.9, "flat.position": 3.95, "initial_speed": SPEED}


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """A short track and one wheel."""
    structure = Structure(bays=12, elements_per_bay=4, wheels=1, gauges=1)
    return ensure_fmus(tmp_path_factory.mktemp("pair"), structure, contact="track")


@pytest.fixture(scope="module")
def bogies(tmp_path_factory):
    """A short track and four wheels."""
    structure = Structure(bays=16, elements_per_bay=4, wheels=4, gauges=0)
    return ensure_fmus(tmp_path_factory.mktemp("bogies"), structure, contact="track")


def small_track(open_fmu, pair, **values):
    return open_fmu(pair.track, **(SMALL | values))


def drive_track(track, first, last, step=1e-4):
    for k in range(first, last):
        track.set("wheel[1].position", 3.9 + SPEED * step * k)
        track.set("wheel[1].displacement", 2e-4 * (1.0 - np.cos(0.05 * k)))
        track.fmu.doStep(k * step, step)


# what they say


def test_descriptions_are_sound_and_names_meet(pair, bogies):
    for paths in (pair, bogies):
        assert validate_fmu(str(paths.track)) == []
        assert validate_fmu(str(paths.vehicle)) == []
    track, masses = (
        {v.name: v for v in read_model_description(str(path)).modelVariables}
        for path in (bogies.track, bogies.vehicle)
    )
    for wheel in (1, 2, 3, 4):
        for quantity in ("position", "displacement", "contact_force"):
            ends = [side[f"wheel[{wheel}].{quantity}"] for side in (track, masses)]
            assert {end.causality for end in ends} == {"input", "output"}
            assert ends[0].unit == ends[1].unit
            assert ends[0].nominal == ends[1].nominal
    for variables in (track, masses):
        for variable in variables.values():
            assert len(variable.description) > 10, variable.name
            assert variable.unit or variable.type != "Real", variable.name


@pytest.mark.slow
def test_all_claims_hold(pair):
    """Seven processes an FMU."""
    for path in (pair.track, pair.vehicle):
        assert [item for item in check_fmu(path) if not item.holds] == []


# static start


def test_no_value_has_to_go_round_at_the_start(open_fmu, pair):
    """Forces are static whatever the displacement, displacements zero whatever the force."""
    track = small_track(open_fmu, pair, **{"wheel[1].displacement": 0.8e-3})
    assert track.get("wheel[1].contact_force") == STATIC_LOAD
    masses = open_fmu(pair.vehicle, **{"wheel[1].contact_force": 0.0})
    assert masses.get("wheel[1].displacement") == 0.0
    other = small_track(open_fmu, pair)
    level = [one.get("wheel[1].static_displacement") for one in (track, other)]
    assert level[1] - level[0] == pytest.approx(0.8e-3, rel=1e-12)
    # rail, no drop, compression
    compression = (STATIC_LOAD / 9.17e10) ** (2.0 / 3.0)
    rail = other.get("wheel[1].rail_displacement")
    assert level[1] == pytest.approx(rail + compression, rel=1e-12)


def test_a_host_that_steps_the_vehicle_first_is_told_what_to_set(open_fmu, pair):
    track = small_track(open_fmu, pair)
    track.set("wheel[1].position", 3.9 + 1e-4 * SPEED)
    track.fmu.doStep(0.0, 1e-4)
    assert "set linear_inputs = true in a host that steps the vehicle first" in track.messages[-1]
    told = small_track(open_fmu, pair, linear_inputs=True)
    told.set("wheel[1].position", 3.9 + 1e-4 * SPEED)
    told.fmu.doStep(0.0, 1e-4)
    assert told.messages == []


def test_a_host_with_long_steps_is_told(open_fmu, pair):
    track = small_track(open_fmu, pair)
    track.fmu.doStep(0.0, 2e-4)
    assert track.messages == []
    other = small_track(open_fmu, pair)
    other.fmu.doStep(0.0, 1e-3)
    other.fmu.doStep(1e-3, 1e-3)
    assert len(other.messages) == 1  # once is enough
    assert "steps of 0.001 s are too long" in other.messages[0]
    assert "use 0.0002 s or less" in other.messages[0]


# state


def test_rollback_and_serialisation_are_bitwise(open_fmu, pair):
    slave = small_track(open_fmu, pair)
    drive_track(slave, 0, 10)
    saved = slave.fmu.getFMUstate()
    data = slave.fmu.serializeFMUstate(saved)
    drive_track(slave, 10, 30)
    first = slave.outputs()
    slave.fmu.setFMUstate(saved)
    slave.fmu.doStep(10 * 1e-4, 7e-4)  # a detour
    slave.fmu.setFMUstate(saved)
    slave.fmu.freeFMUstate(saved)
    drive_track(slave, 10, 30)
    assert slave.outputs() == first
    other = open_fmu(pair.track, initialise=False)
    copy = other.fmu.deSerializeFMUstate(data)
    other.fmu.setFMUstate(copy)
    other.fmu.freeFMUstate(copy)
    drive_track(other, 10, 30)
    assert other.outputs() == first


# refusals


@pytest.mark.parametrize(
    ("side", "name", "value", "sentence"),
    [
        ("track", "hertz_coefficient", -1.0, "hertz_coefficient is -1"),
        ("track", "static_wheel_load", -5.0, "static_wheel_load = -5.0 N"),
        ("track", "flat.wheel", 3, "flat is on wheel 3"),
        ("track", "rail_irregularity", "missing.csv", "missing.csv: cannot be read"),
        ("vehicle", "wheel_mass", 0.0, "wheel_mass is 0 kg"),
        ("vehicle", "speed", 0.0, "speed"),
    ],
)
def test_wrong_parameters_end_the_initialisation_with_a_sentence(
    open_fmu, pair, side, name, value, sentence
):
    slave = open_fmu(getattr(pair, side), initialise=False, **{name: value})
    with pytest.raises(FMICallException):
        slave.initialise()
    assert any(sentence in message for message in slave.messages), slave.messages


def test_an_impossible_step_is_discarded_and_leaves_the_state(open_fmu, pair):
    slave = small_track(open_fmu, pair)
    drive_track(slave, 0, 5)
    before = slave.outputs()
    slave.set("wheel[1].displacement", float("nan"))
    with pytest.raises(FMICallException, match="discard"):
        slave.fmu.doStep(5e-4, 1e-4)
    assert "displacement nan m of wheel 1" in slave.messages[-1]
    assert slave.outputs() == before


# together, without a master


def jacobi(track, masses, wheels, steps, step=1e-4):
    """Forces of all wheels over time; the loop that the simplest host runs."""
    motion = [f"wheel[{i}].{q}" for q in ("position", "displacement") for i in wheels]
    force = [f"wheel[{i}].contact_force" for i in wheels]
    forces = [[track.get(name) for name in force]]
    for k in range(steps):
        moved = {name: masses.get(name) for name in motion}
        pressed = {name: track.get(name) for name in force}
        for name, value in moved.items():
            track.set(name, value)
        for name, value in pressed.items():
            masses.set(name, value)
        track.fmu.doStep(k * step, step)
        masses.fmu.doStep(k * step, step)
        forces.append([track.get(name) for name in force])
    return np.array(forces)


def test_two_bogies_start_at_rest_and_stay_near_it(open_fmu, bogies):
    """Round wheels at walking pace: the sleepers pass beneath, nothing jumps."""
    offsets = (0.0, 1.8, 4.0, 5.8)
    start, speed = 8.0, 1.0
    track = open_fmu(
        bogies.track,
        **{"mode_pairs": 48, "flat.shape": "none", "initial_speed": speed},
        **{f"wheel[{i}].position": start - d for i, d in enumerate(offsets, start=1)},
    )
    masses = open_fmu(
        bogies.vehicle,
        speed=speed,
        initial_position=start,
        **{f"wheel[{i}].offset": d for i, d in enumerate(offsets, start=1) if i > 1},
    )
    forces = jacobi(track, masses, (1, 2, 3, 4), 300)
    assert (forces[0] == STATIC_LOAD).all()
    assert np.abs(forces - STATIC_LOAD).max() < 0.02 * STATIC_LOAD
    assert np.abs(np.diff(forces, axis=0)).max() < 1e-3 * STATIC_LOAD
    assert masses.get("wheel[4].position") == pytest.approx(start - 5.8 + 0.03, rel=1e-12)


def strike(open_fmu, pair, depth, step, *, held=None):
    """One wheel with a flat over the short track; a vehicle of the host's own where `held`."""
    track = small_track(open_fmu, pair, **{"flat.depth": depth})
    masses = open_fmu(pair.vehicle, initial_position=3.9, speed=SPEED)
    steps = round(0.03 / step)
    if held is None:
        return jacobi(track, masses, (1,), steps, step)[:, 0]
    z, v, forces = 0.0, 0.0, []
    for k in range(steps):
        track.set("wheel[1].position", 3.9 + SPEED * step * k)
        track.set("wheel[1].displacement", z)
        acceleration = (STATIC_LOAD - track.get(held)) / 592.5
        z, v = z + step * (v + 0.5 * step * acceleration), v + step * acceleration
        track.fmu.doStep(k * step, step)
        forces.append(track.get("wheel[1].contact_force"))
    return np.array(forces)


@pytest.mark.parametrize("depth", [0.9e-3, 2e-3], ids=["in contact", "lost contact"])
def test_the_peak_at_100_us_is_that_of_small_steps(open_fmu, pair, depth):
    exact = strike(open_fmu, pair, depth, 2.5e-5).max()
    assert exact > 1.5 * STATIC_LOAD
    assert strike(open_fmu, pair, depth, 1e-4).max() == pytest.approx(exact, rel=1e-3)
    assert (strike(open_fmu, pair, depth, 1e-4).min() == 0.0) == (depth > 1e-3)


def test_a_vehicle_that_holds_its_inputs_wants_the_force_ahead(open_fmu, pair):
    """Held contact forces come half a step late, which is 1 % of the peak at 100 us."""
    exact = strike(open_fmu, pair, 0.9e-3, 2.5e-5).max()
    ahead = strike(open_fmu, pair, 0.9e-3, 1e-4, held="wheel[1].contact_force_ahead").max()
    late = strike(open_fmu, pair, 0.9e-3, 1e-4, held="wheel[1].contact_force").max()
    assert ahead == pytest.approx(exact, rel=2e-3)
    assert abs(late - exact) > 5e-3 * exact


def test_many_instances_live_and_die_in_one_process(pair):
    places = set()
    for _ in range(10):
        slave = Instance(pair.vehicle)
        slave.fmu.doStep(0.0, 1e-4)
        places.add(slave.get("wheel[1].position"))
        slave.close()
    assert len(places) == 1
