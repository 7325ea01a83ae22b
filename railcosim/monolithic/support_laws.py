"""What ballast and pads of all supports bear beyond the springs and dampers in the matrices."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from fmu_src.python.track_laws import CHARACTERISTIC, read_pad

from ..errors import InputError
from .curves import PowerCurve, ballast_curve, point_curve
from .laws import BallastLaw, Tangent
from .moving_ballast import MovingBallast
from .pad_laws import ElasticPads, RelaxingPads
from .support_properties import properties_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scenario import Scenario
    from ..track_section import Track
    from .pad_laws import PadLaw, Relaxation
    from .support_properties import LinearSupports, SupportProperties

    Array = NDArray[np.float64]


class SmallMotion(NamedTuple):
    """Components at rest and about it, ballast under all sleepers first, then all pads.

    Attributes
    ----------
    force : ndarray, shape (ports,)
        At rest [N].
    stiffness, damping : ndarray, shape (ports,)
        Of springs and dampers [N/m], [N s/m].
    branch_stiffness, branch_damping : ndarray, shape (ports,)
        Of branches in parallel to them [N/m], [N s/m]; 0 where there is none.
    mass : ndarray, shape (ports,)
        What moves with a component [kg].
    """

    force: Array
    stiffness: Array
    damping: Array
    branch_stiffness: Array
    branch_damping: Array
    mass: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportLaws:
    """Forces at the ports of a track: ballast under all sleepers, then all pads if they have ports.

    Attributes
    ----------
    ballast : BallastLaw
        Of the ballast.
    moving : MovingBallast
        What of it moves along.
    pads : PadLaw
        Of the pads.
    pads_have_ports : bool
        Whether the pads bear anything beyond what is in the matrices.
    base : LinearSupports
        What is in the matrices.
    supports : SupportProperties
        What differs from support to support.
    """

    ballast: BallastLaw
    moving: MovingBallast
    pads: PadLaw
    pads_have_ports: bool
    base: LinearSupports
    supports: SupportProperties

    @property
    def memories(self) -> int:
        """How many states the laws have."""
        return self.pads.memories

    def tangent(self, deformation: Array, rate: Array, memory: Array) -> Tangent:
        """Return what is borne beyond the matrices.

        Parameters
        ----------
        deformation, rate : ndarray, shape (ports,)
            [m], [m/s].
        memory : ndarray, shape (memories,)
            States of the pads [N]; forces fall with them, one to one where a pad presses.
        """
        count = len(self.supports.gap)
        base = self.base
        beds = _less(
            self.ballast.tangent(deformation[:count], rate[:count]),
            (base.ballast_stiffness, base.ballast_damping),
            (deformation[:count], rate[:count]),
        )
        if not self.pads_have_ports:
            return beds
        pads = _less(
            self.pads.tangent(deformation[count:], rate[count:], memory),
            (base.pad_stiffness, base.pad_damping),
            (deformation[count:], rate[count:]),
        )
        return Tangent(*(np.concatenate(pair) for pair in zip(beds, pads, strict=True)))

    def by_memory(self, deformation: Array, memory: Array) -> Array:
        """Return the derivative of each port's force by its pad's memory, (ports,); 0 for others.

        Arguments as of `tangent`.
        """
        derivative = np.zeros_like(deformation)
        if self.memories:
            pads = slice(len(deformation) - self.memories, None)
            still = np.zeros_like(memory)
            pressed = self.pads.tangent(deformation[pads], still, memory).stiffness > 0.0
            derivative[pads] = -1.0 * (pressed & (self.pads.branches(deformation[pads])[0] > 0.0))
        return derivative

    def relaxed(self, deformation: Array) -> Array:
        """Return the memories of a track at rest [N]."""
        return self.pads.relaxed(deformation[len(deformation) - self.memories :])

    def relaxation(self, deformation: Array, memory: Array) -> Relaxation:
        """Return how memories change where ports are deformed so much [m]."""
        return self.pads.relaxation(deformation[len(deformation) - self.memories :], memory)

    def about_rest(self, deformation: Array) -> SmallMotion:
        """Return what is borne at rest beyond the matrices, and by small motions about it."""
        still, count = np.zeros_like(deformation), len(self.supports.gap)
        force, stiffness, damping = self.tangent(deformation, still, self.relaxed(deformation))
        branch_stiffness, branch_damping, mass = np.zeros((3, len(force)))
        mass[:count] = self.supports.own.sleeper_mass + self.moving.at(deformation[:count]).mass
        mass[:count] -= self.base.mass
        if self.pads_have_ports:
            pads = slice(count, None)
            branch_stiffness[pads], branch_damping[pads] = self.pads.branches(deformation[pads])
        return SmallMotion(
            force, stiffness - branch_stiffness, damping, branch_stiffness, branch_damping, mass
        )

    def with_masses_in_matrices(self) -> SupportLaws:
        """Return the same where the matrices hold all masses, of ballast that is not pressed."""
        own = self.supports.own
        return replace(
            self,
            base=replace(self.base, sleeper_mass=own.sleeper_mass, ballast_mass=own.ballast_mass),
        )

    def loose(self) -> NDArray[np.bool_]:
        """Return which ports can open, (ports,)."""
        own = self.supports
        ends = [own.sleeper_lifts, own.rail_lifts] if self.pads_have_ports else [own.sleeper_lifts]
        return np.concatenate(ends)


def support_laws(
    scenario: Scenario, track: Track, *, all_in_matrices: bool, first_bay: int = 0
) -> SupportLaws:
    """Return the laws of a scenario.

    Parameters
    ----------
    scenario : Scenario
        Its supports.
    track : Track
        Its track, or what is held of an endless one.
    all_in_matrices : bool
        Whether the matrices hold what springs and dampers are linear of every support, whatever
        they are; or else the nominal ones.
    first_bay : int
        Bays between 0 m and the first end of the track.

    Raises
    ------
    InputError
        For a table that cannot be used, or ballast with a mass that a sleeper can lift off.
    """
    supports = properties_of(scenario, track, first_bay=first_bay)
    if track.ballast_mass > 0.0 and supports.sleeper_lifts.any():
        raise InputError(
            f"track.ballast_mass is {track.ballast_mass:g} kg and a sleeper can lift off its "
            "ballast, but receptances and the monolithic solution hold masses that are never left "
            "behind: set track.ballast_mass to 0, or let the ballast pull and close the gaps"
        )
    pads = _pad_law(track, supports)
    linear = track.pad == "linear"
    loose_pads = supports.rail_lifts if linear else np.ones(len(supports.gap), dtype=np.bool_)
    base = supports.nominal
    if all_in_matrices:
        own = supports.own
        base = replace(
            base,
            pad_stiffness=np.where(loose_pads, 0.0, own.pad_stiffness),
            pad_damping=np.where(loose_pads, 0.0, own.pad_damping),
            ballast_stiffness=np.where(supports.sleeper_lifts, 0.0, own.ballast_stiffness),
            ballast_damping=np.where(supports.sleeper_lifts, 0.0, own.ballast_damping),
        )
    held = np.array_equal(base.pad_stiffness, supports.own.pad_stiffness) and np.array_equal(
        base.pad_damping, supports.own.pad_damping
    )
    curve = ballast_curve(track)
    return SupportLaws(
        ballast=BallastLaw(
            curve=curve,
            tau=track.ballast_damping / track.ballast_stiffness,
            tangent_damping=track.ballast_tangent_damping,
            supports=supports,
        ),
        moving=MovingBallast(
            curve=curve,
            stiffness=track.ballast_stiffness,
            mass=track.ballast_mass,
            grows=track.ballast_mass_grows,
            supports=supports,
        ),
        pads=pads,
        pads_have_ports=not (linear and held) or bool(supports.rail_lifts.any()),
        base=base,
        supports=supports,
    )


def _pad_law(track: Track, supports: SupportProperties) -> PadLaw:
    if track.pad == "linear":
        return ElasticPads(curve=PowerCurve(stiffness=track.pad_stiffness), supports=supports)
    try:
        columns = read_pad(track.pad)
    except ValueError as error:
        raise InputError(str(error)) from error
    if len(columns) == len(CHARACTERISTIC):
        return ElasticPads(curve=point_curve(**columns), supports=supports)
    return RelaxingPads(columns, clip_preload=track.clip_preload, supports=supports)


def _less(whole: Tangent, linear: tuple[Array, Array], motion: tuple[Array, Array]) -> Tangent:
    """Take springs and dampers out of a force."""
    force = whole.force - linear[0] * motion[0] - linear[1] * motion[1]
    return Tangent(force, whole.stiffness - linear[0], whole.damping - linear[1])
