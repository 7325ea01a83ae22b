"""Ballast by its whole force, support by support; the increment is what the linear one lacks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .assembly import IntArray
from .beam_element import FloatArray
from .characteristics import Characteristic, Jet
from .component_law import MemorylessLaw
from .support_factors import SupportFactors

ONSET = 20e-6
"""Closure over which the damping sets in of ballast from which a sleeper can lift off [m]."""
TINY = 1e-12  # m; below it a secant is a tangent


class Contact(NamedTuple):
    """How much of damping and mass has set in, and the least force that the ballast can bear.

    Attributes
    ----------
    share, slope, bend : float array
        From 0 where the sleeper has lifted off to 1, and derivatives [1/m], [1/m2].
    gone : bool array
        Whether the sleeper has lifted off.
    least : float array
        Of the force beyond that at rest [N]; minus infinity where the ballast pulls.
    """

    share: FloatArray
    slope: FloatArray
    bend: FloatArray
    gone: NDArray[np.bool_]
    least: FloatArray


class Parts(NamedTuple):
    """Elastic force, damping coefficient, their slopes, and the contact with the sleeper."""

    load: FloatArray
    tangent: FloatArray
    damping: FloatArray
    damping_slope: FloatArray
    contact: Contact


def secant(x: FloatArray, jet: Jet) -> tuple[FloatArray, FloatArray]:
    """Secant stiffness [N/m] and its derivative [N/m2] of a load given at displacements x [m]."""
    small = np.abs(x) < TINY
    safe = np.where(small, 1.0, x)
    stiffness = np.where(small, jet.tangent, jet.load / safe)
    return stiffness, np.where(small, 0.5 * jet.curvature, (jet.tangent - stiffness) / safe)


@dataclass(frozen=True, slots=True, kw_only=True)
class TotalBallast(MemorylessLaw):
    """Increment ``total(x - gap, x') - k x - c x'`` of Eq. (24), which works for every support.

    The total is ``f_k e(x) + f_c d(x) x'`` with the whole characteristic ``e = k x + e_inc(x)`` and
    the damping ``d = tau e / x`` (secant, Eq. (30)) or ``tau e'`` (tangent), ``tau = c / k``. As
    displacements, it is counted from the track at rest under its own weight.

    Ballast that does not pull bears the dead weight ``w`` of sleeper and rail there. It can lose
    that and no more: the total is never below ``-w``, which is where the sleeper has lifted off. A
    sleeper over a gap hangs from the rail at rest, its ballast bears nothing and ``w`` is zero.
    From lifting off on, the damping sets in over the load of the first `ONSET`, or over all of
    ``w`` where that is less, so that nothing jumps and the track at rest has all of it.

    Parameters
    ----------
    characteristic : Characteristic
        ``e_inc``: load less that of the linear spring.
    linear_stiffness, linear_damping : float
        Of the linear ballast, ``k`` and ``c`` [N/m], [N s/m].
    factors : SupportFactors
        Of the supports.
    tangent_damping : bool
        Which of the two dampings.
    pulls : bool
        Whether a lifted sleeper is pulled back, as in the paper's model.
    sleeper_weight, rail_weight : float
        Of a nominal sleeper and of the rail in a bay, under one rail seat [N].
    """

    characteristic: Characteristic
    linear_stiffness: float
    linear_damping: float
    factors: SupportFactors
    sleeper_weight: float
    rail_weight: float
    tangent_damping: bool = False
    pulls: bool = True

    @property
    def stiff(self) -> bool:
        """Yes; see `ComponentLaw.stiff`."""
        return True

    def moved(self, first: int, count: int) -> TotalBallast:
        """Return the law of other supports; see `ComponentLaw.moved`."""
        return replace(self, factors=self.factors.window(first, count))

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N]; see `ComponentLaw.force`."""
        parts = self.parts(deformation, support)
        total = np.maximum(parts.load + parts.damping * rate, parts.contact.least)
        linear = self.linear_stiffness * deformation + self.linear_damping * rate
        return np.asarray(total - linear)

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the deformation [N/m]; see `ComponentLaw.stiffness`."""
        parts = self.parts(deformation, support)
        by_deformation = parts.tangent + parts.damping_slope * rate
        lifted = parts.load + parts.damping * rate < parts.contact.least
        return np.where(lifted, 0.0, by_deformation) - self.linear_stiffness

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the rate [N s/m]; see `ComponentLaw.damping`."""
        parts = self.parts(deformation, support)
        lifted = parts.load + parts.damping * rate < parts.contact.least
        return np.where(lifted, 0.0, parts.damping) - self.linear_damping

    def parts(self, deformation: FloatArray, support: IntArray) -> Parts:
        """What the whole force is made of at given deformations [m], shape (c,) each."""
        of, k, c = self.factors, self.linear_stiffness, self.linear_damping
        x = deformation - of.gap[support]
        jet = self.characteristic.jet(x)
        tau = c / k
        if self.tangent_damping:
            excess, slope = jet.tangent, jet.curvature
        else:
            excess, slope = secant(x, jet)
        damping = c + tau * excess
        damping_slope = tau * slope
        spring, damper = of.ballast_stiffness[support], of.ballast_damping[support]
        load, tangent = spring * (k * x + jet.load), spring * (k + jet.tangent)
        contact = self._contact(Jet(load, tangent, spring * jet.curvature), support)
        return Parts(
            np.where(contact.gone, contact.least, load),
            np.where(contact.gone, 0.0, tangent),
            damper * (contact.share * damping),
            damper * (contact.share * damping_slope + contact.slope * damping),
            contact,
        )

    def _contact(self, bed: Jet, support: IntArray) -> Contact:
        """Contact of sleepers on beds with such loads beyond those at rest."""
        of = self.factors
        gap, spring = of.gap[support], of.ballast_stiffness[support]
        loose = (gap > 0.0) | (not self.pulls)
        rests = loose & (gap == 0.0) & (spring > 0.0)
        weight = self.sleeper_weight * of.sleeper_mass[support] + self.rail_weight
        weight = np.where(rests, weight, 0.0)
        pressed = bed.load + weight
        whole = ONSET * self.linear_stiffness * spring
        whole = np.where(rests, np.minimum(whole, weight), whole)
        gone = loose & ~(pressed > 0.0)
        setting_in = loose & ~gone & (pressed < whole)
        over = np.where(setting_in, whole, 1.0)
        return Contact(
            np.where(gone, 0.0, np.where(setting_in, pressed / over, 1.0)),
            np.where(setting_in, bed.tangent / over, 0.0),
            np.where(setting_in, bed.curvature / over, 0.0),
            gone,
            np.where(loose, -weight, -np.inf),
        )
