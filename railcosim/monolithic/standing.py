"""How a vehicle stands on the rail at the start, and how fast its bodies rise or fall there."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vehicle_fmu.suspended_vehicle import SWAY
from vehicle_fmu.vehicle_model import INSTANT

from ..errors import RunError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .course import Course
    from .laws import HertzLaw
    from .vehicle import Vehicle

    Array = NDArray[np.float64]

MOST_ITERATIONS, MOST_HALVINGS = 100, 10
BALANCED, SETTLED = 1e-11, 1e-10
"""What may be left of a push on a body, and of a change of wheel loads, over the static load."""


class Standing(NamedTuple):
    """A vehicle in static equilibrium.

    Attributes
    ----------
    rest : float
        Mean displacement of the wheels, from which all coordinates count [m].
    place, rate : ndarray, shape (c,)
        Coordinates and their rates.
    loads : ndarray, shape (wheels,)
        Contact forces [N].
    """

    rest: float
    place: Array
    rate: Array
    loads: Array


def stand(
    vehicle: Vehicle,
    contact: HertzLaw,
    course: Course,
    *,
    load: float,
    sag: Callable[[Array], Array],
) -> Standing:
    """Put a vehicle on the rail, with the loads that the heights of its wheels leave them.

    Wheels move as the surface under them does, bodies above as it does in the mean over `SWAY`.

    Parameters
    ----------
    vehicle, contact, course
        What stands where.
    load : float
        Static load of every wheel on a level rail [N].
    sag : callable
        Displacement of the rail under every wheel [m] for given wheel loads [N].

    Raises
    ------
    RunError
        If there is no equilibrium, or loads and track do not settle.
    """
    loads = np.full(vehicle.wheels, load)
    rate = vehicle.riding(_drop_rates(course, SWAY))
    rate[: vehicle.wheels] = _drop_rates(course, INSTANT)
    for _ in range(MOST_ITERATIONS):
        levels = sag(loads) + course.drops(0.0)
        rest, place = _balanced(vehicle, contact, levels, load)
        before, loads = loads, _pressed(contact, rest, place, levels)
        if np.abs(loads - before).max() <= SETTLED * load:
            return Standing(rest, place, rate, loads)
    raise RunError(
        f"the wheel loads at the start do not settle in {MOST_ITERATIONS} rounds: begin on a more "
        "even rail, or with softer bump stops"
    )


def _balanced(
    vehicle: Vehicle, contact: HertzLaw, levels: Array, load: float
) -> tuple[float, Array]:
    """Mean displacement of the wheels and coordinates at which nothing pushes any body."""
    heights = levels + contact.compression(load)
    rest, still = float(heights.mean()), np.zeros(len(vehicle.scale))
    w = vehicle.wheels

    def accelerations(place: Array) -> Array:
        push = load - _pressed(contact, rest, place, levels)
        return vehicle.accelerations(place, still, push)

    place = vehicle.riding(heights - rest)
    miss = accelerations(place)
    enough = BALANCED * load / vehicle.contact_mass
    for _ in range(MOST_ITERATIONS):
        if np.abs(miss).max() <= enough:
            return rest, place
        tangent = vehicle.tangent(place, still)[0].copy()
        stiffness = contact.tangent(rest + place[:w] - levels).stiffness
        tangent[:, :w] -= vehicle.mobility * stiffness
        change = np.linalg.lstsq(tangent, -miss)[0]
        for share in 0.5 ** np.arange(MOST_HALVINGS):
            there = accelerations(place + share * change)
            if np.linalg.norm(there) < np.linalg.norm(miss):
                break
        place, miss = place + share * change, there
    raise RunError(
        f"the vehicle finds no static equilibrium in {MOST_ITERATIONS} iterations on wheels up to "
        f"{np.abs(heights - rest).max():.3g} m from their mean height: begin on a more even rail"
    )


def _pressed(contact: HertzLaw, rest: float, place: Array, levels: Array) -> Array:
    """Contact forces of wheels over surfaces of given levels [N]."""
    return contact.tangent(rest + place[: len(levels)] - levels).force


def _drop_rates(course: Course, span: float) -> Array:
    """How fast the drop under every wheel grows at the start, in the mean over a time [m/s]."""
    return (course.drops(0.5 * span) - course.drops(-0.5 * span)) / span
