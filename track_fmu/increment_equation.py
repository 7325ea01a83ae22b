"""Force increments at the end of a step, consistent with the motion that they cause."""

from __future__ import annotations

import numpy as np

from .beam_element import FloatArray
from .component_law import Tangents
from .component_motion import ComponentMotion
from .components import ActiveComponents

RELATIVE_TOLERANCE = 1e-13
ABSOLUTE_TOLERANCE = 1e-9  # N
MAX_SWEEPS = 30
MAX_HALVINGS = 6


class IncrementEquation:
    """The equation ``g = law(motion(F, g))`` of a step, and Newton's iteration on it.

    Parameters
    ----------
    active : ActiveComponents
        The components, with laws that hold for the step.
    motion : ComponentMotion
        How they move.
    step_size : float
        Duration of the step [s], which a refusal names.
    forces : (wheels,) float array
        Contact forces before the step [N].
    first : (c,) float array
        Force increments before the step [N]. With the tangents there everything depends on the
        state alone, so that a repeated step is the same bit for bit; where those do not serve, they
        are worked out before every use.

    Attributes
    ----------
    first : (c,) float array
        As given.
    correction : (c, c) float array
        Change of the increments over a miss of what is demanded of them.
    tangents : Tangents
        Of the laws, where the correction was worked out.
    """

    def __init__(
        self,
        active: ActiveComponents,
        motion: ComponentMotion,
        *,
        step_size: float,
        forces: FloatArray,
        first: FloatArray,
    ) -> None:
        self._active, self._motion, self._step_size = active, motion, step_size
        self.first = first
        self.correction: FloatArray
        self.tangents: Tangents
        self.linearise(forces, first)

    @property
    def stiff(self) -> bool:
        """Whether tangents have to be taken where they are used; see `ComponentLaw.stiff`."""
        return self._active.stiff

    def demanded(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Force increments that the motion under given forces and increments asks for, (c,) [N]."""
        return self._active.force(*self._motion.under(forces, increment))

    def linearise(self, forces: FloatArray, increment: FloatArray) -> None:
        """Work out the correction at given forces and increments."""
        self.tangents = self._active.tangents(*self._motion.under(forces, increment))
        jacobian = self._motion.increment_demand(self.tangents)
        self.correction = np.asarray(np.linalg.inv(np.eye(self._active.count) + jacobian))

    def response(self) -> FloatArray:
        """Change of the increments over that of the contact forces, shape (c, wheels)."""
        return np.asarray(self.correction @ self._motion.contact_demand(self.tangents))

    def solve(self, forces: FloatArray) -> FloatArray:
        """Force increments at the end of the step under given contact forces [N], shape (c,).

        Raises
        ------
        RuntimeError
            If the iteration does not converge.
        """
        if self._active.count == 0:
            return self.first
        solve = self._solve_stiffly if self.stiff else self._solve_simply
        with np.errstate(over="ignore", invalid="ignore"):  # divergence is refused
            found = solve(forces)
        if found is None:
            raise RuntimeError(
                f"track: the state-dependent forces did not converge in {MAX_SWEEPS} sweeps over a "
                f"step of {self._step_size:.3g} s; use a shorter step"
            )
        return found

    def _solve_simply(self, forces: FloatArray) -> FloatArray | None:
        """Newton's iteration with the Jacobian of the start."""
        increment = self.first
        for _ in range(MAX_SWEEPS):
            change = self.correction @ (self.demanded(forces, increment) - increment)
            increment = increment + change
            scale = float(np.max(np.abs(increment)))
            if not np.isfinite(scale):
                return None
            limit = RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE
            if float(np.max(np.abs(change))) <= limit:
                return increment
        return None

    def _solve_stiffly(self, forces: FloatArray) -> FloatArray | None:
        """Find the same with the Jacobian of every sweep, and shorter changes where they help."""
        increment = self.first
        miss = self.demanded(forces, increment) - increment
        for _ in range(MAX_SWEEPS):
            self.linearise(forces, increment)
            change = self.correction @ miss
            size = float(np.max(np.abs(change)))
            scale = float(np.max(np.abs(increment)))
            if not np.isfinite(size + scale):
                return None
            if size <= RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE:
                return increment + change
            for halvings in range(MAX_HALVINGS):
                new = increment + 0.5**halvings * change
                new_miss = self.demanded(forces, new) - new
                if np.max(np.abs(new_miss)) <= np.max(np.abs(miss)):
                    break
            increment, miss = new, new_miss
        return None
