"""Ballast of a mass that depends on how far it is pressed, as forces that hang on accelerations.

The matrices hold the mass of ballast that is not pressed. The rest, ``d m(x)``, adds the force
``d m x'' + m_x x'^2 / 2`` on a port, whose acceleration follows from the state and, since a sleeper
has a mass, in proportion from that force itself: ``x'' = a + g h``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .port_forces import PortForces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .linear_track import BedAccelerations
    from .support_laws import SupportLaws

    Array = NDArray[np.float64]


def bed_parts(laws: SupportLaws, ports: int) -> tuple[slice, slice, slice]:
    """Return which of all ports are wheels, which are beds and which are pads."""
    beds = len(laws.supports.gap)
    first = ports - beds * (2 if laws.pads_have_ports else 1)
    return slice(0, first), slice(first, first + beds), slice(first + beds, ports)


def with_inertia(
    slow: PortForces, laws: SupportLaws, beds: BedAccelerations, motion: tuple[Array, Array, Array]
) -> PortForces:
    """Add the inertia of ballast under sleepers that cannot lift off.

    Parameters
    ----------
    slow : PortForces
        Without it.
    laws : SupportLaws
        Of the supports.
    beds : BedAccelerations
        How sleepers accelerate.
    motion : tuple of ndarray, shape (p,), (p,), (supports,)
        Displacements [m] and rates [m/s] of all ports; accelerations of the beds without forces on
        the ports [m/s2].
    """
    _, under, pads = bed_parts(laws, len(slow.force))
    sinking, rate, free = motion[0][under], motion[1][under], motion[2]
    mass = laws.moving.at(sinking)
    more = mass.mass - laws.base.ballast_mass
    if laws.pads_have_ports:
        free = free + beds.of_pad * slow.force[pads]
    left = slow.force[under] - 0.5 * mass.slope * rate**2 - more * free
    force, by_displacement, by_rate = (part.copy() for part in slow[:3])
    by_acceleration = np.zeros_like(force)
    force[under] = left / (1.0 + more * beds.of_bed)
    acceleration = free + beds.of_bed * force[under]
    by_displacement[under] -= mass.slope * acceleration + 0.5 * mass.curvature * rate**2
    by_rate[under] -= mass.slope * rate
    by_acceleration[under] = -more
    return PortForces(force, by_displacement, by_rate, by_acceleration)
