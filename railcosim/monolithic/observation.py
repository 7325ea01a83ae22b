"""What is kept of the solution: the series of a result at given times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..signals import SIGNALS, SLEEPER_SIGNALS
from .moments import WheelLoads, moments_between

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from .system import CoupledSystem, Instant

    Array = NDArray[np.float64]


SLEEPER_MOMENTS = tuple(signal.name for signal in SLEEPER_SIGNALS)
"""At rail seats and centres."""

OF_SLEEPERS = {item.name for item in (*SIGNALS, *SLEEPER_SIGNALS) if item.dim == "sleeper"}
"""Series with a column a sleeper."""


class Observer:
    """Collects series at given times while the steps of an integration go over them.

    Parameters
    ----------
    times : ndarray, shape (m,)
        Increasing, within the run [s].
    gauges : ndarray, shape (gauges,)
        Positions of the bending moments that are wanted, from the first end of the track [m].
    sleepers : slice
        Those that are wanted.
    """

    def __init__(self, times: Array, *, gauges: Array, sleepers: slice) -> None:
        self.times = times
        self._gauges, self._sleepers = gauges, sleepers
        self._seen = 0
        self._parts: list[Mapping[str, Array]] = []

    def see(self, system: CoupledSystem, solution: Callable[[float], Array], until: float) -> None:
        """Keep what there is at the times not seen yet, up to the time given [s]."""
        first = self._seen
        self._seen = int(np.searchsorted(self.times, until, side="right"))
        times = self.times[first : self._seen].tolist()
        if times:
            states = [solution(time) for time in times]
            seen = _observe(system, self._gauges, times, states)
            self._parts.append(
                {  # copies, so that the other sleepers of a long track are let go
                    name: values[self._sleepers].copy() if name in OF_SLEEPERS else values
                    for name, values in seen.items()
                }
            )

    def series(self) -> dict[str, Array]:
        """Return every series by its name in a result, shape (m, wheels or sleepers or gauges)."""
        series = {
            name: np.concatenate([part[name] for part in self._parts], axis=1).T
            for name in self._parts[0]
        }
        # the residual flexibility is no state: its part of the velocity comes from its values
        residual = series.pop("residual_displacement")
        if residual.any():
            series["rail_velocity"] += np.gradient(residual, self.times, axis=0, edge_order=2)
        return series


def _observe(
    system: CoupledSystem, gauges: Array, times: Sequence[float], states: Sequence[Array]
) -> dict[str, Array]:
    """Work out all series at times between which no wheel leaves its element, (k, times) each."""
    track, parts, w = system.track, system.parts, system.wheels
    instants = [system.instant(*at) for at in zip(times, states, strict=True)]
    rates = _columns(
        [
            system.rates_at(time, state, now)
            for time, state, now in zip(times, states, instants, strict=True)
        ]
    )
    state = _columns(states)
    force = _columns([now.forces.force for now in instants])
    displacement = _columns([now.displacement for now in instants])
    level = _columns([now.level for now in instants])
    own, own_rate = state[parts[0]], rates[parts[0]]
    positions = _columns([system.places.course.positions(time) for time in times])
    gap = displacement[:w] - level
    loads, wheel_loads = _loads(system, times, force)
    pad, pad_rate = track.pads(own, own_rate, loads)
    base = system.laws.base
    pad_force = base.pad_stiffness[:, None] * pad + base.pad_damping[:, None] * pad_rate
    if system.laws.pads_have_ports:
        pad_force -= force[len(force) - len(pad) :]
    under, at_gauges = _moments(system, gauges, (own, own_rate, loads), wheel_loads)
    parameters = track.parameters
    supports = parameters.supports
    seats = beds = displacement[w : w + supports]
    bed_rate = (track.supports.output @ own_rate)[:supports]
    inertia = base.ballast_mass[:, None] * (track.supports.rate @ own_rate)[:supports]
    of_sleepers: dict[str, Array] = {}
    if parameters.sleeper == "beam":
        borne = loads.copy()
        borne[len(loads) - len(force) + w :][:supports] -= inertia
        seats, beds, bed_rate, moments = track.bent_sleepers(own, own_rate, borne)
        of_sleepers = dict(zip(SLEEPER_MOMENTS, moments, strict=True))
    bodies = system.vehicle.observe(state[parts[1]], state[parts[2]], rates[parts[2]])
    return of_sleepers | {
        **bodies,
        "contact_force": force[:w],
        "gap": gap,
        "in_contact": (gap < 0.0).astype(float),
        "wheel_position": positions,
        "wheel_displacement": system.wheel_displacements(state),
        "wheel_velocity": state[parts[2]][:w],
        "rail_displacement": displacement[:w],
        "rail_velocity": _velocities(system, times, states, instants, own_rate),
        "residual_displacement": _columns([now.at_once[:w] for now in instants]),
        "bending_moment_under_wheel": under,
        "sleeper_displacement": seats,
        "pad_force": pad_force,
        "ballast_force": base.ballast_stiffness[:, None] * beds
        + base.ballast_damping[:, None] * bed_rate
        + inertia
        - force[w : w + supports],
        "bending_moment": at_gauges,
    }


def _velocities(
    system: CoupledSystem,
    times: Sequence[float],
    states: Sequence[Array],
    instants: Sequence[Instant],
    rates: Array,
) -> Array:
    """Velocity of the rail following each wheel [m/s], without the residual flexibility."""
    return _columns(
        [
            now.wheels.output @ rate + system.convective(time) @ state[system.parts[0]]
            for time, state, now, rate in zip(times, states, instants, rates.T, strict=True)
        ]
    )


def _loads(system: CoupledSystem, times: Sequence[float], force: Array) -> tuple[Array, WheelLoads]:
    """Forces on nodes and supports, shape (2 nodes + ports, times), and the wheels' again."""
    parameters, w = system.track.parameters, system.wheels
    nodal = 2 * (parameters.elements + 1)
    loads = np.zeros((nodal + len(force) - w, len(times)))
    loads[nodal:] = force[w:]
    shapes = np.stack([system.places.shapes(time) for time in times], axis=2)
    for wheel, element in enumerate(system.places.elements.tolist()):
        loads[2 * element : 2 * element + 4] += shapes[wheel] * force[wheel]
    wheels = WheelLoads(
        elements=system.places.elements,
        places=_columns([system.places.within(time) for time in times]),
        couples=np.stack([shapes[:, 1], shapes[:, 3]]),
        forces=force[:w],
    )
    return loads, wheels


def _moments(
    system: CoupledSystem, gauges: Array, own: tuple[Array, Array, Array], wheels: WheelLoads
) -> tuple[Array, Array]:
    """Bending moments under the wheels and at the gauges [N m], from state, rates and loads."""
    parameters = system.track.parameters
    length, last = parameters.element_length, parameters.elements - 1
    at = np.minimum((gauges / length).astype(np.intp), last)
    elements = np.concatenate((wheels.elements, at))
    fixed = np.repeat((gauges / length - at)[:, None], own[0].shape[1], axis=1)
    ends = system.track.nodal_moments(np.concatenate((elements, elements + 1)), *own)
    moments = moments_between(
        ends.reshape(2, len(elements), -1),
        wheels,
        elements=elements,
        places=np.vstack([wheels.places, fixed]),
        length=length,
        last=last,
    )
    return moments[: len(wheels.elements)], moments[len(wheels.elements) :]


def _columns(rows: Sequence[Array]) -> Array:
    return np.stack(rows, axis=1)
