"""Wheels that are not round: what they drop by along the rail, and how that is tabulated."""

import numpy as np
import pytest

from vehicle_fmu.out_of_roundness import FULL_TURN, OutOfRoundness, tread_along_rail
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.surfaces import Surfaces
from vehicle_fmu.vehicle_model import VehicleModel

RADIUS = 0.45
ROUND = FlatParameters(shape="none", position=10.0)
AMPLITUDE = 1e-4


def polygon(order, points=1440, amplitude=AMPLITUDE):
    angle = np.arange(points) * FULL_TURN / points
    return OutOfRoundness(angle=angle, drop=amplitude * np.cos(order * angle))


def test_a_polygon_is_a_sine_along_the_rail():
    """The curve flattens extrema: (order 2 pi / points)^2 / 8 of the amplitude at most, 1e-3."""
    drop = tread_along_rail(polygon(20), position=10.0, radius=RADIUS)
    x = np.linspace(-40.0, 40.0, 5001)
    exact = AMPLITUDE * np.cos(20 * (x - 10.0) / RADIUS)
    found = np.array([drop(p) for p in x.tolist()])
    assert abs(found - exact).max() < 1e-3 * AMPLITUDE


def test_the_error_falls_with_the_square_of_the_spacing():
    x = np.linspace(0.0, FULL_TURN * RADIUS, 4001)
    exact = AMPLITUDE * np.cos(9 * x / RADIUS + 0.1)

    def error(points):
        angle = np.arange(points) * FULL_TURN / points
        table = OutOfRoundness(angle=angle, drop=AMPLITUDE * np.cos(9 * angle + 0.1))
        drop = tread_along_rail(table, position=0.0, radius=RADIUS)
        return max(abs(np.array([drop(p) for p in x.tolist()]) - exact))

    assert error(200) / error(400) > 0.9 * 2.0**2


def test_it_comes_back_after_every_turn():
    table = OutOfRoundness(angle=[0.3, 1.0, 2.0, 4.0, 6.0], drop=[0.0, 1e-4, -2e-4, 1e-4, 3e-5])
    drop = tread_along_rail(table, position=3.0, radius=RADIUS)
    turn = FULL_TURN * RADIUS
    for s in (0.0, 0.1, 0.7, 2.0, 2.75):
        # positions far along the rail lose a few digits
        assert drop(3.0 + s + 7 * turn) == pytest.approx(drop(3.0 + s), abs=1e-16)
        assert drop(3.0 + s - 7 * turn) == pytest.approx(drop(3.0 + s), abs=1e-16)
    for angle, value in zip(table.angle.tolist(), table.drop.tolist(), strict=True):
        assert drop(3.0 + RADIUS * angle) == pytest.approx(value, abs=1e-16)


def test_every_wheel_has_its_own_and_the_flat_comes_on_top():
    flat = FlatParameters(shape="parabola", length=0.1, depth=1e-3, wheel=2, position=10.0)
    surfaces = Surfaces(
        flat,
        flat_table=None,
        irregularity=None,
        out_of_roundness=[polygon(3), polygon(1, amplitude=2e-4), None],
        wheels=3,
        radius=RADIUS,
    )
    assert surfaces.drops(np.full(3, 10.0)) == pytest.approx([1e-4, 1.2e-3, 0.0], rel=1e-12)


def test_the_vehicle_starts_in_equilibrium_on_it_and_drops_by_it():
    vehicle = VehicleModel(
        VehicleParameters(initial_position=10.0, offsets=(0.0, RADIUS * FULL_TURN / 2)),
        flat=ROUND,
        speed=ConstantSpeed(speed=1.0),
        out_of_roundness=[polygon(1), polygon(1)],
    )
    vehicle.initialise(0.0)
    assert vehicle.contact_force == pytest.approx(117_720.0, rel=1e-12)
    # the second wheel is half a turn behind
    assert np.diff(vehicle.displacement)[0] == pytest.approx(-2.0 * AMPLITUDE, rel=1e-9)


@pytest.mark.parametrize(
    ("angle", "sentence"),
    [
        ([0.0, 90.0, 180.0, 270.0], "from 0 to 270 rad; it must be at least 0 and below 2 pi"),
        ([-0.1, 1.0, 2.0, 3.0], "from -0.1"),
        ([0.0, 2.0, 4.0, FULL_TURN], "leave out a last point"),
        ([0.0, 2.0, 2.0, 3.0], "must increase"),
        ([0.0, 1.0, 2.0], "at least 4"),
    ],
)
def test_a_table_that_is_no_turn_is_refused(angle, sentence):
    with pytest.raises(ValueError, match=sentence):
        OutOfRoundness(angle=angle, drop=np.zeros(len(angle)))


def test_a_table_a_wheel_or_none():
    with pytest.raises(ValueError, match="given for 1 wheels, the vehicle has 2"):
        VehicleModel(
            VehicleParameters(),
            flat=ROUND,
            speed=ConstantSpeed(speed=1.0),
            out_of_roundness=[polygon(1)],
        )
