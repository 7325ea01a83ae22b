"""Track and vehicle as one system of ordinary differential equations, Eq. (15)-(18).

The state is ``{track, q, q'}``, of the vehicle's coordinates and their rates; with contact in the
form of constraints ``{track, q, q', s, I}``, with the displacements of the contact points and the
impulses of the contact forces, as in Eq. (15). Pads that relax have states behind these.

``hertz``: the contact force follows from the compression ``z - drop - u`` of a wheel, where its
displacement ``z`` comes from the vehicle's coordinates and that of the rail, ``u``, from the state
of the track.

``constraint``: a contact point ``s`` without mass belongs to the vehicle. It is tied to the rail by
the velocity constraint ``s' = d/dt u(x(t), t)``, with the convective part of a point that moves
along; between it and the wheel are Hertz's spring and, in series, the residual flexibility. The
force is the rate of the impulse, ``I' = F``. Irregularities enter as drops, the integral of the
rates in Eq. (17).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np
import scipy.sparse as sp

from .bed_inertia import with_inertia
from .linear_track import Feedthrough, Ports
from .port_forces import Laws, PortForces, solve_port_forces
from .vehicle import FREQUENCY

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .laws import HertzLaw
    from .linear_track import LinearTrack, Matrix
    from .rail_places import RailPlaces
    from .support_laws import SupportLaws
    from .vehicle import Vehicle

ContactForm: TypeAlias = Literal["hertz", "constraint"]
"""How the contact is written."""


class Instant(NamedTuple):
    """The system at one time and state.

    Attributes
    ----------
    wheels : Ports
        Under the wheels.
    feedthrough : Feedthrough or None
        Of all ports.
    displacement, at_once : ndarray, shape (p,)
        Of all ports, wheels first, and what of it the forces cause at once [m].
    forces : PortForces
        On all ports.
    level : ndarray, shape (wheels,)
        Displacements of the wheels less the drops [m].
    """

    wheels: Ports
    feedthrough: Feedthrough | None
    displacement: NDArray[np.float64]
    at_once: NDArray[np.float64]
    forces: PortForces
    level: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class CoupledSystem:
    """The system while no wheel leaves its element of the rail.

    Attributes
    ----------
    track : LinearTrack
        With s components of state.
    vehicle : Vehicle
        With c coordinates, of which the first w are those of the wheels.
    places : RailPlaces
        Of the wheels on the rail.
    contact, laws
        Of the contacts; of ballast and pads.
    form : ContactForm
        How the contact is written.
    static_load : float
        Of each wheel [N].
    rest : float
        Displacement of wheels from which their coordinates count [m].
    """

    track: LinearTrack
    vehicle: Vehicle
    places: RailPlaces
    contact: HertzLaw
    laws: SupportLaws
    form: ContactForm
    static_load: float
    rest: float

    @property
    def wheels(self) -> int:
        """Number of wheels w."""
        return self.vehicle.wheels

    @cached_property
    def parts(self) -> tuple[slice, ...]:
        """Places of track, q, q', with constraints s and I, and what pads remember in the state."""
        coordinates = len(self.vehicle.scale)
        sizes = [len(self.track.scale), coordinates, coordinates]
        if self.form == "constraint":
            sizes += [self.wheels, self.wheels]
        ends = np.cumsum([*sizes, self.laws.memories])
        return tuple(slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True))

    @property
    def size(self) -> int:
        """Length of the state."""
        return int(self.parts[-1].stop)

    @cached_property
    def scale(self) -> NDArray[np.float64]:
        """How large a component of the state is where displacements are one metre, (size,)."""
        vehicle, ones = self.vehicle, np.ones(self.wheels)
        parts = [self.track.scale, vehicle.scale, vehicle.rate_scale]
        if self.form == "constraint":
            parts += [ones, vehicle.contact_mass * FREQUENCY * ones]
        remembered = np.full(self.laws.memories, self.laws.pads.memory_scale)
        return np.concatenate([*parts, remembered])

    @cached_property
    def mass(self) -> sp.csc_array | None:
        """What multiplies the derivative of the state, None for the unit matrix."""
        if self.track.mass is None:
            return None
        others = sp.eye_array(self.size - self.track.mass.shape[0])
        return sp.csc_array(sp.block_diag([self.track.mass, others]))

    def moved_to(self, time: float) -> CoupledSystem:
        """Return the system with the wheels on the elements where they are at a time."""
        return replace(self, places=self.places.moved_to(time))

    def begin(
        self,
        own: NDArray[np.float64],
        place: NDArray[np.float64],
        rate: NDArray[np.float64],
        memory: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return the state at t = 0, shape (size,).

        Parameters
        ----------
        own : ndarray, shape (s,)
            State of the track.
        place, rate : ndarray, shape (c,)
            Coordinates of the vehicle and their rates.
        memory : ndarray, shape (memories,)
            Of the laws.
        """
        state = np.zeros(self.size)
        for part, values in zip(self.parts, (own, place, rate), strict=False):
            state[part] = values
        state[self.parts[-1]] = memory
        if self.form == "constraint":
            under = self.track.wheels(self.places.elements, self.places.shapes(0.0))
            state[self.parts[3]] = under.output @ own
        return state

    def instant(self, time: float, state: NDArray[np.float64]) -> Instant:
        """Solve for the forces."""
        track, parts = self.track, self.parts
        own, elements, shapes = state[parts[0]], self.places.elements, self.places.shapes(time)
        wheels = track.wheels(elements, shapes)
        under = wheels.output @ own if self.form == "hertz" else state[parts[3]]
        displacement = np.concatenate((under, track.supports.output @ own))
        rate = np.concatenate((np.zeros(self.wheels), track.supports.rate @ own))
        feedthrough = track.feedthrough(elements, shapes)
        level = self.wheel_displacements(state) - self.places.course.drops(time)
        forces = solve_port_forces(
            Laws(self.contact, self.laws, level, state[parts[-1]]), displacement, rate, feedthrough
        )
        if track.beds is not None and self.laws.moving.varies:
            forces = with_inertia(
                forces, self.laws, track.beds, (displacement, rate, track.beds.of_state @ own)
            )
        at_once = np.zeros_like(displacement)
        if feedthrough is not None:
            at_once = feedthrough.flexibility @ forces.force
        return Instant(wheels, feedthrough, displacement + at_once, at_once, forces, level)

    def rates(self, time: float, state: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivative of the state, Eq. (18), shape (size,)."""
        return self.rates_at(time, state, self.instant(time, state))

    def rates_at(
        self, time: float, state: NDArray[np.float64], now: Instant
    ) -> NDArray[np.float64]:
        """Return the same where the forces are known."""
        track, parts = self.track, self.parts
        force, borne = np.split(now.forces.force, [self.wheels])
        load = now.wheels.inputs.T @ force + track.supports.inputs.T @ borne
        rate = np.empty(self.size)
        rate[parts[0]] = track.advance(state[parts[0]], load)
        rate[parts[1]] = state[parts[2]]
        rate[parts[2]] = self.vehicle.accelerations(
            state[parts[1]], state[parts[2]], self.static_load - force
        )
        if self.form == "constraint":
            rate[parts[3]] = now.wheels.output @ rate[parts[0]]
            rate[parts[3]] += self.convective(time) @ state[parts[0]]
            rate[parts[4]] = force
        if self.laws.memories:
            deformed = now.displacement[self.wheels :]
            rate[parts[-1]] = self.laws.relaxation(deformed, state[parts[-1]]).rate
        return rate

    def wheel_displacements(self, states: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the displacements of the wheels [m], shape (wheels,); or of states (size, n)."""
        return np.asarray(self.rest + states[self.parts[1]][: self.wheels])

    def gaps(self, time: float, state: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the gap between each wheel and the rail [m], minus the compression."""
        now = self.instant(time, state)
        return now.displacement[: self.wheels] - now.level

    def margins(self, time: float, state: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return what changes sign at every switch of a contact or bump stop [m]: gaps first."""
        ways = self.vehicle.ways_to_stops(state[self.parts[1]])
        return np.concatenate((self.gaps(time, state), ways))

    def convective(self, time: float) -> Matrix:
        """Return what makes ``v du/dx`` under each wheel from the track's state, (wheels, s)."""
        slopes = self.track.wheels(self.places.elements, self.places.slopes(time))
        return self.places.course.speed(time) * slopes.output
