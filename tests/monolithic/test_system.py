"""The equations of the monolith: derivatives, start, and both forms of the contact."""

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.monolithic import solve
from railcosim.monolithic.course import course_of
from railcosim.monolithic.held_track import held_track
from railcosim.monolithic.integrators import Accuracy
from railcosim.monolithic.jacobian import jacobian
from railcosim.monolithic.scenario_system import make_system
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise
from railcosim.surfaces.tables import compose

STATIC_LOAD = 117_720.0
MASS = 592.5
SMALL = ("track.bays=10", "flat.position=3.6", "run.approach=0.2", "run.departure=0.2")
ONE = (*SMALL, "vehicle.wheels=1")
BOTH = [("modal", "hertz"), ("modal", "constraint"), ("full", "hertz"), ("full", "constraint")]


def small(*overrides):
    return read_scenario(None, (*ONE, *overrides))


def built(scenario, model, form):
    course = course_of(scenario, compose(scenario))
    return make_system(scenario, held_track(scenario), course, model=model, contact_form=form)


SUSPENDED = (
    "vehicle.model=suspended",
    "suspension.tread_mass=200",
    "suspension.tread_stiffness=5e8",
    "suspension.primary_rebound_ratio=3",
    "suspension.primary_clearance=-1e-3",
    "suspension.primary_stop_stiffness=2e6",
)


@pytest.mark.parametrize("vehicle", [(), SUSPENDED], ids=["masses", "suspended"])
@pytest.mark.parametrize(("model", "form"), BOTH)
def test_the_jacobian_is_the_derivative(model, form, vehicle):
    system, state = built(read_scenario(None, (*SMALL, *vehicle)), model, form)
    random = np.random.default_rng(4)
    state[system.parts[2]] += 0.1 * random.standard_normal(len(system.vehicle.scale))
    change = 1e-9 * system.scale * random.standard_normal(system.size)
    time = 1e-4
    rates = (system.rates(time, state + change) - system.rates(time, state - change)) / 2.0
    if system.mass is not None:
        rates = system.mass @ rates
    expected = jacobian(system, time, state) @ change
    # central differences of a law with curvature 1e12 N/m2 over 1 nm, and rounding
    assert np.abs(rates - expected).max() < 1e-5 * np.abs(expected).max()
    moved = slice(system.parts[1].start, system.parts[2].stop)  # the vehicle by itself
    assert rates[moved] == pytest.approx(
        expected[moved], rel=1e-6, abs=1e-6 * np.abs(expected[moved]).max()
    )


@pytest.mark.parametrize("vehicle", [(), SUSPENDED], ids=["masses", "suspended"])
@pytest.mark.parametrize(("model", "form"), BOTH)
def test_the_start_is_static(model, form, vehicle):
    system, state = built(small(*vehicle), model, form)
    now = system.instant(0.0, state)
    # the modes that are left out do not follow the velocity of the track
    assert now.forces.force[0] == pytest.approx(STATIC_LOAD, rel=1e-4)
    assert (system.gaps(0.0, state) < 0.0).all()
    rates = system.rates(0.0, state)[system.parts[2]]
    assert (rates[1:] == 0.0).all()  # everything above the tread of the one wheel


@pytest.fixture(scope="module")
def solutions():
    scenario = small("flat.depth=1.4e-3")
    times = np.linspace(0.0, 0.036, 721)
    return {
        (model, form): solve(scenario, model=model, contact_form=form, times=times)
        for model, form in BOTH
    }


def force(passage):
    return passage["contact_force"].sel(wheel=1).to_numpy()


def test_both_forms_of_the_contact_have_one_solution(solutions):
    """Through loss and recovery of contact; the tolerances of the integration remain."""
    for model in ("modal", "full"):
        one, other = solutions[model, "hertz"], solutions[model, "constraint"]
        assert one.attrs["switches"] == other.attrs["switches"] >= 2
        assert force(one).min() == 0.0
        assert np.abs(force(one) - force(other)).max() < 3e-3 * STATIC_LOAD


def test_modes_with_residual_are_the_full_track_under_a_smooth_flat(solutions):
    modal, full = (summarise(solutions[model, "hertz"]) for model in ("modal", "full"))
    for name in (
        "peak_contact_force",
        "max_sleeper_displacement",
        "peak_bending_moment_midspan",
        "peak_bending_moment_under_wheel",
    ):
        assert getattr(modal, name) == pytest.approx(getattr(full, name), rel=3e-3), name
    assert modal.loss_of_contact_time == pytest.approx(full.loss_of_contact_time, abs=2e-5)


@pytest.mark.parametrize("kind", BOTH)
def test_the_wheel_obeys_newton(solutions, kind):
    """The trapezoidal rule over 50 us leaves less than a thousandth of the static impulse."""
    passage = solutions[kind]
    time = passage["time"].to_numpy()
    velocity = passage["wheel_velocity"].sel(wheel=1).to_numpy()
    impulse = np.trapezoid(STATIC_LOAD - force(passage), time)
    change = MASS * (velocity[-1] - velocity[0])
    assert impulse == pytest.approx(change, abs=1e-5 * STATIC_LOAD * time[-1])


def test_rail_velocity_is_the_derivative_of_rail_displacement(solutions):
    for kind in BOTH:
        passage = solutions[kind]
        rail = passage["rail_displacement"].sel(wheel=1).to_numpy()
        slope = np.gradient(rail, passage["time"].to_numpy())[1:-1]
        ours = passage["rail_velocity"].sel(wheel=1).to_numpy()[1:-1]
        # mean, since the slope of the rail jumps where the wheel passes a node
        assert np.abs(slope - ours).mean() < 5e-3 * np.abs(ours).max()


def test_every_bump_stop_is_met_and_left_where_it_is():
    """As often as the compression of the only primary spring passes its clearance."""
    clearance = 1e-5
    passage = solve(
        small(
            "vehicle.model=suspended",
            "flat.depth=0.4e-3",
            f"suspension.primary_clearance={clearance}",
            "suspension.primary_stop_stiffness=2e7",
        )
    )
    assert (passage["gap"] < 0.0).all()
    bogie = passage["bogie_displacement"].sel(bogie=1).to_numpy()
    wheel = passage["wheel_displacement"].sel(wheel=1).to_numpy()
    beyond = bogie - (wheel - wheel[0]) - clearance
    switches = np.flatnonzero(np.diff(beyond > 0.0))
    assert passage.attrs["switches"] == len(switches) >= 2
    # spring, damper and stop: the force of what the bodies do
    rate = np.gradient(beyond, passage["time"].to_numpy(), edge_order=2)
    expected = 1.2e6 * (beyond + clearance) + 4e3 * rate + 2e7 * np.maximum(beyond, 0.0)
    force = passage["primary_force"].sel(wheel=1).to_numpy()
    assert force - force[0] == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())


def test_a_tighter_tolerance_changes_little():
    scenario = small("run.approach=0.1", "run.departure=0.1")
    rough, fine = (solve(scenario, accuracy=Accuracy(atol=atol)) for atol in (1e-8, 1e-9))
    assert fine.attrs["steps_accepted"] > rough.attrs["steps_accepted"]
    assert np.abs(force(rough) - force(fine)).max() < 2e-3 * STATIC_LOAD


def test_what_cannot_be_used_is_refused():
    with pytest.raises(InputError, match="model is 'half' but must be one of modal, full"):
        solve(small(), model="half")
    with pytest.raises(
        InputError, match=r"takes 431 bays of the endless track, but .* at most 400"
    ):
        solve(read_scenario(None, ("track.endless=true", "run.departure=240")))
    with pytest.raises(InputError, match=r"rtol is 1\.0 but must lie between"):
        Accuracy(rtol=1.0)
    with pytest.raises(InputError, match="method is 'Euler' but must be one of Radau, BDF"):
        Accuracy(method="Euler")
    with pytest.raises(InputError, match="must be two or more, increase and lie between"):
        solve(small(), times=np.array([0.0, 1.0]))
