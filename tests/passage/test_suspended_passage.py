"""Passages of a suspended vehicle: its limit, and both sides of the contacts."""

import numpy as np
import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario

from .reference_case import STATIC_LOAD

SHORT = ("run.approach=0.6", "run.departure=0.6", "master.step=1e-4")
SUSPENDED = "vehicle.model=suspended"


def native(*overrides, contact="vehicle"):
    return run_passage(read_scenario(None, (*SHORT, *overrides)), fmus="native", contact=contact)


@pytest.fixture(scope="module")
def masses():
    return native()


@pytest.fixture(scope="module")
def suspended():
    return native(SUSPENDED)


def largest(difference):
    return float(np.abs(difference).max())


def test_very_soft_springs_leave_moving_masses(masses):
    """Springs of 10 N/m: a millionth of the static load; what is left is theirs and rounding."""
    soft = native(SUSPENDED, "suspension.primary_stiffness=10", "suspension.primary_damping=0")
    difference = soft["contact_force"].to_numpy() - masses["contact_force"].to_numpy()
    assert largest(difference) < 1e-6 * STATIC_LOAD


def test_the_bodies_hardly_matter_to_a_strike(masses, suspended):
    """A flat strikes at tens of hertz and above, where primary springs hold little: 1.2 %."""
    ours, theirs = (p["contact_force"].max("time").to_numpy() for p in (suspended, masses))
    assert ours[0] == pytest.approx(theirs[0], rel=2e-2)
    assert ours[0] != theirs[0]


def test_the_suspension_carries_what_the_wheels_do_not_weigh(suspended):
    """Static forces at the start; over time, Newton's law of the car body."""
    on_wheel = STATIC_LOAD - 592.5 * 9.81
    assert suspended["primary_force"][0].to_numpy() == pytest.approx([on_wheel] * 2, rel=1e-9)
    on_car = float(suspended["secondary_force"][0, 0])
    car = on_car / 9.81
    lifted = (on_car - suspended["secondary_force"][:, 0].to_numpy()) / car
    assert suspended["car_acceleration"][:, 0].to_numpy() == pytest.approx(lifted, abs=1e-9)


def test_both_sides_of_the_contacts_move_the_bodies_alike(suspended):
    on_track = native(SUSPENDED, contact="track")
    for name in ("bogie_displacement", "bogie_pitch", "car_displacement"):
        ours, theirs = suspended[name], on_track[name].interp(time=suspended["time"])
        assert largest(ours) > 1e-9, name
        assert largest(theirs - ours) < 0.01 * largest(ours), name


@pytest.mark.parametrize("contact", ["vehicle", "track"])
def test_python_fmus_move_the_bodies_as_native_ones_do(contact):
    keys = ("run.approach=0.08", "run.departure=0.1", "suspension.tread_mass=200",
            "suspension.tread_stiffness=5e8", SUSPENDED)  # fmt: skip
    ours = native(*keys, contact=contact)
    theirs = run_passage(read_scenario(None, (*SHORT, *keys)), fmus="python", contact=contact)
    for name in ("contact_force", "primary_force", "bogie_acceleration", "car_displacement"):
        scale = largest(ours[name])
        assert largest(ours[name].to_numpy() - theirs[name].to_numpy()) < 1e-6 * scale, name


def test_a_flexible_wheelset_softens_the_strike(masses):
    """Less mass strikes first; at a stiffness of nearly a rigid wheelset hardly."""
    keys = ("suspension.tread_mass=300", "suspension.tread_damping=1e3")
    soft, stiff = (native(*keys, f"suspension.tread_stiffness={k}") for k in (3e8, 3e10))
    peak, rigid, softer = (float(p["contact_force"].max()) for p in (stiff, masses, soft))
    assert peak == pytest.approx(rigid, rel=0.02)
    assert softer < 0.98 * rigid


def test_both_sides_of_the_contacts_start_three_axles_in_the_same_equilibrium(tmp_path):
    """Loads and heights depend on each other through track and springs; the master settles both."""
    x = np.arange(0.0, 32.0, 0.05)
    rail = tmp_path / "rail.csv"
    rows = (f"{a!r},{3e-3 * np.sin(2.0 * a)!s}\n" for a in x.tolist())
    rail.write_text("position,drop\n" + "".join(rows), encoding="ascii")
    keys = ("vehicle.wheels=3", "vehicle.axle_base=1.7", "flat.shape=none", SUSPENDED)
    starts = [
        native(*keys, f"vehicle.rail_irregularity={rail}", "run.departure=0.01", contact=contact)
        for contact in ("vehicle", "track")
    ]
    ours, theirs = (start["contact_force"][0].to_numpy() for start in starts)
    assert np.abs(ours / STATIC_LOAD - 1.0).min() > 5e-3
    assert ours.sum() == pytest.approx(3.0 * STATIC_LOAD, rel=1e-9)
    assert theirs == pytest.approx(ours, rel=1e-9)
    rates = [start["wheel_velocity"][0].to_numpy() for start in starts]
    assert np.abs(rates[0]).max() > 0.02
    assert rates[1] == pytest.approx(rates[0], rel=1e-6)
