"""Track and wheels as one system of ordinary differential equations, Eq. (15)-(18).

The state is ``{track, z, z'}``, of the wheels' displacements and velocities; with contact in the
form of constraints ``{track, z, z', s, I}``, with the displacements of the contact points and the
impulses of the contact forces, as in Eq. (15). Pads that relax have states behind these.

``hertz``: the contact force follows from the compression ``z - drop - u``, where the rail
displacement ``u`` comes from the state of the track.

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

from track_fmu.beam_element import deflection_shape, deflection_slope, shear_parameter

from .blocks import DENSE, SPARSE
from .linear_track import Feedthrough, Ports
from .port_forces import Laws, PortForces, solve_port_forces

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .blocks import Blocks
    from .course import Course
    from .laws import HertzLaw
    from .linear_track import LinearTrack, Matrix
    from .support_laws import SupportLaws

ContactForm: TypeAlias = Literal["hertz", "constraint"]
"""How the contact is written."""


FREQUENCY = 1e4
"""Velocities may be wrong by this times what displacements may be [rad/s]."""


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
    course : Course
        Of w wheels.
    contact, laws
        Of the wheels; of ballast and pads.
    form : ContactForm
        How the contact is written.
    wheel_mass, static_load : float
        Of each wheel [kg], [N].
    elements : ndarray, shape (wheels,)
        On which the wheels are.
    """

    track: LinearTrack
    course: Course
    contact: HertzLaw
    laws: SupportLaws
    form: ContactForm
    wheel_mass: float
    static_load: float
    elements: NDArray[np.intp]

    @property
    def wheels(self) -> int:
        """Number of wheels w."""
        return len(self.elements)

    @cached_property
    def parts(self) -> tuple[slice, ...]:
        """Places of track, z, z', with constraints s and I, and the laws' memories in the state."""
        ends = len(self.track.scale) + self.wheels * np.arange(
            5 if self.form == "constraint" else 3
        )
        ends = np.append(ends, ends[-1] + self.laws.memories)
        return tuple(slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True))

    @property
    def size(self) -> int:
        """Length of the state."""
        return int(self.parts[-1].stop)

    @cached_property
    def scale(self) -> NDArray[np.float64]:
        """How large a component of the state is where displacements are one metre, (size,)."""
        others = np.ones(self.size - len(self.track.scale))
        scale = np.concatenate((self.track.scale, others))
        scale[self.parts[2]] = FREQUENCY
        scale[self.parts[-1]] = self.laws.pads.memory_scale
        if self.form == "constraint":
            scale[self.parts[4]] = self.wheel_mass * FREQUENCY
        return scale

    @cached_property
    def mass(self) -> sp.csc_array | None:
        """What multiplies the derivative of the state, None for the unit matrix."""
        if self.track.mass is None:
            return None
        others = sp.eye_array(self.size - self.track.mass.shape[0])
        return sp.csc_array(sp.block_diag([self.track.mass, others]))

    def moved_to(self, time: float) -> CoupledSystem:
        """Return the system with the wheels on the elements where they are at a time."""
        length = self.track.parameters.element_length
        elements = np.floor(self.course.positions(time) / length).astype(np.intp)
        return replace(self, elements=np.clip(elements, 0, self.track.parameters.elements - 1))

    def weights(self, time: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the shape functions of deflection and slope under the wheels, (wheels, 4) each."""
        parameters = self.track.parameters
        length = parameters.element_length
        phi = shear_parameter(parameters.section, length)
        places = (self.course.positions(time) / length - self.elements).tolist()
        return (
            np.array([deflection_shape(xi, length, phi) for xi in places]),
            np.array([deflection_slope(xi, length, phi) for xi in places]),
        )

    def at_rest(
        self,
        own: NDArray[np.float64],
        rail: NDArray[np.float64],
        memory: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return the state with the wheels at rest at t = 0 under their static loads.

        Parameters
        ----------
        own : ndarray, shape (s,)
            State of the track.
        rail : ndarray, shape (wheels,)
            Displacement of the rail under each wheel [m].
        memory : ndarray, shape (memories,)
            Of the laws.
        """
        state = np.zeros(self.size)
        state[self.parts[0]], state[self.parts[-1]] = own, memory
        compression = self.contact.compression(self.static_load)
        state[self.parts[1]] = rail + self.course.drops(0.0) + compression
        if self.form == "constraint":
            shape, _ = self.weights(0.0)
            state[self.parts[3]] = self.track.wheels(self.elements, shape).output @ own
        return state

    def instant(self, time: float, state: NDArray[np.float64]) -> Instant:
        """Solve for the forces."""
        track, parts = self.track, self.parts
        own = state[parts[0]]
        shape, _ = self.weights(time)
        wheels = track.wheels(self.elements, shape)
        under = wheels.output @ own if self.form == "hertz" else state[parts[3]]
        displacement = np.concatenate((under, track.supports.output @ own))
        rate = np.concatenate((np.zeros(self.wheels), track.supports.rate @ own))
        feedthrough = track.feedthrough(self.elements, shape)
        level = state[parts[1]] - self.course.drops(time)
        forces = solve_port_forces(
            Laws(self.contact, self.laws, level, state[parts[-1]]), displacement, rate, feedthrough
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
        rate[parts[2]] = (self.static_load - force) / self.wheel_mass
        if self.form == "constraint":
            rate[parts[3]] = now.wheels.output @ rate[parts[0]]
            rate[parts[3]] += self.convective(time) @ state[parts[0]]
            rate[parts[4]] = force
        if self.laws.memories:
            deformed = now.displacement[self.wheels :]
            rate[parts[-1]] = self.laws.relaxation(deformed, state[parts[-1]]).rate
        return rate

    def gaps(self, time: float, state: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the gap between each wheel and the rail [m], minus the compression."""
        now = self.instant(time, state)
        return now.displacement[: self.wheels] - now.level

    def jacobian(self, time: float, state: NDArray[np.float64]) -> Matrix:
        """Return the derivative of ``mass y'`` by the state, sparse where the track's matrix is."""
        now, track, w = self.instant(time, state), self.track, self.wheels
        blocks = SPARSE if sp.issparse(track.matrix) else DENSE
        _, rate, inputs = (blocks.matrix(part) for part in now.wheels)
        forces = self._force_jacobian(now, state[self.parts[-1]], blocks)
        on_wheels = forces[:w]
        rows = [
            self._padded(track.matrix, blocks)
            + inputs.T @ on_wheels
            + track.supports.inputs.T @ forces[w:],
            self._columns({2: np.eye(w)}, blocks),
            -on_wheels / self.wheel_mass,
        ]
        if self.form == "constraint":
            along = self._padded(rate + blocks.matrix(self.convective(time)), blocks)
            if now.feedthrough is not None:
                along = along + now.feedthrough.mobility[:w] @ forces
            rows += [along, on_wheels]
        if self.laws.memories:
            rows.append(self._memory_jacobian(now, state[self.parts[-1]], forces, blocks))
        return blocks.stack(rows)

    def convective(self, time: float) -> Matrix:
        """Return what makes ``v du/dx`` under each wheel from the track's state, (wheels, s)."""
        _, slope = self.weights(time)
        return self.course.speed(time) * self.track.wheels(self.elements, slope).output

    def _force_jacobian(self, now: Instant, memory: NDArray[np.float64], blocks: Blocks) -> Matrix:
        """Derivative of all port forces by the state, shape (p, size)."""
        w, track = self.wheels, self.track
        tied = self.form == "constraint"
        compression = self._columns({1: -np.eye(w)} | ({3: np.eye(w)} if tied else {}), blocks)
        if not tied:
            compression = compression + self._padded(blocks.matrix(now.wheels.output), blocks)
        displacement = blocks.stack([compression, self._padded(track.supports.output, blocks)])
        still = blocks.zeros(w, self.size)
        rate = blocks.stack([still, self._padded(track.supports.rate, blocks)])
        forces: Matrix = sp.diags_array(now.forces.by_displacement) @ displacement
        forces = forces + sp.diags_array(now.forces.by_rate) @ rate
        if self.laws.memories:
            by_memory = self.laws.by_memory(now.displacement[w:], memory)
            forces = forces - blocks.matrix(self._remembering(by_memory, first=w))
        if now.feedthrough is None:
            return forces
        return np.linalg.solve(now.forces.sensitivity(now.feedthrough), forces)

    def _memory_jacobian(
        self, now: Instant, memory: NDArray[np.float64], forces: Matrix, blocks: Blocks
    ) -> Matrix:
        """Derivative of the rates of the memories by the state, shape (memories, size)."""
        change = self.laws.relaxation(now.displacement[self.wheels :], memory)
        deformation = self._padded(self.track.supports.output, blocks)
        if now.feedthrough is not None:
            deformation = deformation + now.feedthrough.flexibility[self.wheels :] @ forces
        deformed = deformation[deformation.shape[0] - len(memory) :]
        own = self._remembering(change.by_memory, first=0)
        return sp.diags_array(change.by_displacement) @ deformed + blocks.matrix(own)

    def _remembering(self, values: NDArray[np.float64], *, first: int) -> NDArray[np.float64]:
        """Rows with values of the last ones, one a memory, in the columns of the memories."""
        rows = np.zeros((first + len(values), self.size))
        count = self.laws.memories
        np.fill_diagonal(rows[len(rows) - count :, self.parts[-1]], values[len(values) - count :])
        return rows

    def _padded(self, rows: Matrix, blocks: Blocks) -> Matrix:
        """Rows that see the track alone, as rows that see the whole state."""
        return blocks.beside([rows, blocks.zeros(rows.shape[0], self.size - rows.shape[1])])

    def _columns(self, given: Mapping[int, NDArray[np.float64]], blocks: Blocks) -> Matrix:
        """Rows, one a wheel, of given blocks in the columns of given parts of the state."""
        rows = np.zeros((self.wheels, self.size))
        for part, block in given.items():
            rows[:, self.parts[part]] = block
        return blocks.matrix(rows)
