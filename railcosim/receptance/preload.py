"""Pads and ballast linearised about the static equilibrium under a preload."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from track_fmu.assembly import assemble

from ..errors import InputError
from ..input_tables import check_laws
from ..monolithic.full_track import port_incidence
from ..monolithic.static_start import static_start
from ..monolithic.support_laws import SmallMotion, support_laws
from ..track_data import track_parameters

if TYPE_CHECKING:
    import scipy.sparse as sp

    from track_fmu.assembly import IntArray
    from track_fmu.eigensolver import ComplexArray

    from ..monolithic.support_laws import SupportLaws
    from ..scenario import Scenario
    from .points import TrackPoint


ROUNDING = 1e-12
"""Of a stiffness or a damping, below which a difference from the nominal one is none."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportTangent:
    """What pads and ballast have more of, for small motions, than the nominal linear ones.

    Attributes
    ----------
    ports : (p,) int array
        Their numbers among all: ballast under every sleeper first, then every pad.
    incidence : (N, p) sparse array
        What deforms them.
    small : SmallMotion
        Their springs, dampers, branches and masses beyond the nominal ones.
    """

    ports: IntArray
    incidence: sp.csc_array
    small: SmallMotion

    def branches(self, omega: float) -> ComplexArray:
        """Stiffness of the branches at an angular frequency [rad/s], ``k1 i w c1 / (k1 + i w c1)``.

        Shape (p,) [N/m].
        """
        spring, dashpot = self.small.branch_stiffness, 1j * omega * self.small.branch_damping
        return np.asarray(spring * dashpot / np.where(spring > 0.0, spring + dashpot, 1.0))

    def dynamic_stiffness(self, omega: float) -> ComplexArray:
        """Stiffness of all of it at an angular frequency [rad/s], ``k + i w c - w^2 m``, (p,)."""
        linear = self.small.stiffness + 1j * omega * self.small.damping
        linear = linear - omega**2 * self.small.mass
        return np.asarray(linear + self.branches(omega))


def support_tangent(
    scenario: Scenario, *, point: TrackPoint, force: float
) -> SupportTangent | None:
    """Linearise all pads and all ballast about the equilibrium under a standing load on the rail.

    Parameters
    ----------
    scenario : Scenario
        Its track and the supports of that.
    point : TrackPoint
        Where the load stands.
    force : float
        The load [N], downwards positive; 0 is the unloaded track.

    Returns
    -------
    SupportTangent or None
        None where nothing is left beside the nominal linear track.

    Raises
    ------
    InputError
        For a table that cannot be used, laws that do not go together, or an unloaded track with
        things that can lift off.
    RunError
        If there is no equilibrium.
    """
    check_laws(scenario)
    laws = support_laws(scenario, scenario.track, all_in_matrices=False)
    if force == 0.0:
        _refuse_kinks(laws)
    matrices = assemble(track_parameters(scenario.track))
    incidence = port_incidence(matrices, pad_ports=laws.pads_have_ports)
    load = np.zeros(matrices.numbering.size)
    free = point.dofs >= 0
    load[point.dofs[free]] = force * point.weights[free]
    displacement = load
    if force != 0.0:
        displacement, _ = static_start(matrices, laws, load=load, load_rate=np.zeros_like(load))
    small = _without_rounding(laws, laws.about_rest(incidence.T @ displacement))
    there = np.flatnonzero(
        (small.stiffness != 0.0)
        | (small.damping != 0.0)
        | (small.branch_stiffness != 0.0)
        | (small.mass != 0.0)
    )
    if not len(there):
        return None
    return SupportTangent(
        ports=there,
        incidence=incidence[:, there],
        small=SmallMotion(*(values[there] for values in small)),
    )


def _without_rounding(laws: SupportLaws, small: SmallMotion) -> SmallMotion:
    """Leave nothing where springs and dampers are the nominal ones."""
    nominal, ports = laws.supports.nominal, len(small.stiffness)
    springs = np.append(nominal.ballast_stiffness, nominal.pad_stiffness)[:ports]
    dampers = np.append(nominal.ballast_damping, nominal.pad_damping)[:ports]
    return small._replace(
        stiffness=np.where(np.abs(small.stiffness) > ROUNDING * springs, small.stiffness, 0.0),
        damping=np.where(np.abs(small.damping) > ROUNDING * dampers, small.damping, 0.0),
    )


def _refuse_kinks(laws: SupportLaws) -> None:
    """Refuse an unloaded track on which a small motion opens and closes something."""
    if laws.supports.rail_lifts.any():
        raise InputError(
            "an unloaded track has no receptance where a rail that is not fastened just touches "
            "its pads: fasten it, or give a preload with --preload"
        )
