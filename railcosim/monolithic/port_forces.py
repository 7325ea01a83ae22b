"""Forces on all ports at one instant: contacts, ballast and pads, with what they cause."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..errors import RunError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .laws import HertzLaw
    from .linear_track import Feedthrough
    from .support_laws import SupportLaws

MOST_ITERATIONS = 60
RELATIVE_TOLERANCE, ABSOLUTE_TOLERANCE = 1e-12, 1e-7
"""Of the largest force, and [N]."""


class PortForces(NamedTuple):
    """Forces on the ports, wheels first, with their tangents at the solution.

    Attributes
    ----------
    force : ndarray, shape (p,)
        Contact forces, then minus what ballast and pads bear beyond the matrices [N].
    by_displacement, by_rate : ndarray, shape (p,)
        Derivatives of the laws by the displacement [N/m] and velocity [N s/m] of their own port.
    by_acceleration : ndarray, shape (p,), or None
        Likewise by its acceleration [kg]; None where nothing depends on that.
    """

    force: NDArray[np.float64]
    by_displacement: NDArray[np.float64]
    by_rate: NDArray[np.float64]
    by_acceleration: NDArray[np.float64] | None = None

    def sensitivity(self, feedthrough: Feedthrough | None) -> NDArray[np.float64]:
        """Return what is left of a force on each port once all others answer, shape (p, p)."""
        matrix = np.eye(len(self.force))
        if feedthrough is not None:
            matrix -= self.by_displacement[:, None] * feedthrough.flexibility
            matrix -= self.by_rate[:, None] * feedthrough.mobility
        return matrix


class Laws(NamedTuple):
    """The laws of all ports.

    Attributes
    ----------
    contact, supports
        Laws of the wheels; of ballast and pads.
    level : ndarray, shape (wheels,)
        Where each wheel would lie on an undeformed rail, its own displacement less the drops [m].
    memory : ndarray, shape (memories,)
        States of the pads [N].
    """

    contact: HertzLaw
    supports: SupportLaws
    level: NDArray[np.float64]
    memory: NDArray[np.float64]

    def at(self, displacement: NDArray[np.float64], rate: NDArray[np.float64]) -> PortForces:
        """Return what the laws answer to displacements [m] and rates [m/s] of all ports, (p,)."""
        wheels = len(self.level)
        hertz = self.contact.tangent(self.level - displacement[:wheels])
        borne = self.supports.tangent(displacement[wheels:], rate[wheels:], self.memory)
        return PortForces(
            np.concatenate((hertz.force, -borne.force)),
            -np.concatenate((hertz.stiffness, borne.stiffness)),
            -np.concatenate((hertz.damping, borne.damping)),
        )


def solve_port_forces(
    laws: Laws,
    displacement: NDArray[np.float64],
    rate: NDArray[np.float64],
    feedthrough: Feedthrough | None,
) -> PortForces:
    """Find the forces that the laws give for what the forces themselves cause at once.

    Newton's iteration, from contacts without force: the force that is left to add is concave in
    the force, so that it approaches from below and never leaves the branch in contact.

    Parameters
    ----------
    laws : Laws
        Of the ports.
    displacement, rate : ndarray, shape (p,)
        Of the ports [m], [m/s], without what the forces cause at once.
    feedthrough : Feedthrough or None
        What they cause.

    Raises
    ------
    RunError
        If the iteration does not end.
    """
    answer = laws.at(displacement, rate)
    if feedthrough is None:
        return answer
    force = answer.force.copy()
    force[: len(laws.level)] = 0.0
    for _ in range(MOST_ITERATIONS):
        answer = laws.at(
            displacement + feedthrough.flexibility @ force, rate + feedthrough.mobility @ force
        )
        miss = answer.force - force
        tolerance = RELATIVE_TOLERANCE * np.abs(answer.force).max() + ABSOLUTE_TOLERANCE
        if np.abs(miss).max() <= tolerance:
            return answer
        force = force + np.linalg.solve(answer.sensitivity(feedthrough), miss)
    raise RunError(
        f"the forces of contacts and supports did not settle in {MOST_ITERATIONS} iterations at "
        f"a miss of {np.abs(miss).max():.3g} N: raise track.mode_pairs, or use the full model"
    )
