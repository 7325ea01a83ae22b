"""Fixed points z = G(z) by quasi-Newton iteration: finite differences and good Broyden updates."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .decision import Cause, Failure
from .participant import Matrix, Vector

Evaluate = Callable[[Vector], Failure | None]
"""Computes G(z); the result is fetched separately."""
Guess = Callable[[], Matrix | None]
"""Returns an inverse Jacobian that nobody has tried, at the z evaluated last, if there is one."""

slow_contraction = 0.5
"""A residual that shrinks by less than this asks for a new Jacobian."""

good_contraction = 0.01
"""A Jacobian that solves the equations by shrinking the residual to less than this stays as is.

A guess that leaves more gives way to differences, which pay off in later steps.
"""

rounding = 2.0**-52


class Solution(NamedTuple):
    """How an iteration ended.

    Attributes
    ----------
    failure : Failure or None
        Why there is no solution, if there is none.
    inverse : numpy.ndarray, shape (n, n), or None
        Inverse Jacobian of the scaled residual, as learned.
    evaluations : int
        How often G was computed.
    residual_norm : float
        Largest remaining residual over the nominal value.
    """

    failure: Failure | None
    inverse: Matrix | None
    evaluations: int
    residual_norm: float


@dataclass(frozen=True, slots=True, kw_only=True)
class FixedPoint:
    """A system z = G(z) with scales and bounds.

    All work is done in y = z / nominal on the residual r(y) = (G(z) - z) / nominal.

    Attributes
    ----------
    names : sequence of str
        Unknowns, for messages.
    nominal, lower, upper : numpy.ndarray, shape (n,)
        Scale and bounds of z; iterates are clipped to the bounds.
    tolerance : float
        Largest residual that counts as solved.
    max_iterations : int
        Corrections of z after which to give up.
    perturbation : float
        Increment of the finite differences in y.
    """

    names: Sequence[str]
    nominal: Vector
    lower: Vector
    upper: Vector
    tolerance: float
    max_iterations: int
    perturbation: float = 1e-5

    def solve(
        self,
        evaluate: Evaluate,
        fetch: Callable[[], Vector],
        start: Vector,
        inverse: Matrix | None,
        guess: Guess | None = None,
    ) -> Solution:
        """Iterate from `start` with the inverse Jacobian `inverse`, or without any knowledge.

        The last evaluation is the one of the solution. A guess costs one evaluation if it is wrong:
        a correction with it that fails or makes the residual no smaller is undone and not counted.

        Parameters
        ----------
        evaluate : callable
            Computes G(z) or says why not.
        fetch : callable
            Returns what was computed, shape (n,).
        start : numpy.ndarray, shape (n,)
            First guess; it is not changed.
        inverse : numpy.ndarray, shape (n, n), or None
            From an earlier solution; it is not changed.
        guess : callable, optional
            Asked once where `inverse` is None, before finite differences.
        """
        z = start
        failure = evaluate(z)
        evaluations = 1
        if failure is not None:
            return Solution(failure, inverse, evaluations, float("nan"))
        residual = (fetch() - z) / self.nominal
        norm = largest(residual)
        iterations, differenced = 0, False
        if guess is not None and inverse is None and norm > self.tolerance:
            z, residual, inverse, more = self._try(guess(), evaluate, fetch, z, residual)
            norm = largest(residual)
            evaluations += more
        while norm > self.tolerance:
            if inverse is None:
                inverse, failure = self._difference(evaluate, fetch, z, residual)
                evaluations += z.size
                differenced = True
            if iterations == self.max_iterations:
                failure = self._not_converged(z, residual, norm)
            if failure is not None or inverse is None:
                return Solution(failure, None, evaluations, norm)
            z_before, before, norm_before = z, residual, norm
            z = self._corrected(z, inverse, residual)
            failure = self._runs_away(z) or evaluate(z)
            iterations += 1
            evaluations += 1
            if failure is not None:
                return Solution(failure, None, evaluations, norm)
            residual = (fetch() - z) / self.nominal
            norm = largest(residual)
            if norm > slow_contraction * norm_before and norm > self.tolerance and not differenced:
                inverse = None
            elif norm > good_contraction * norm_before or norm > self.tolerance:
                inverse = broyden(inverse, (z - z_before) / self.nominal, residual - before)
            differenced = False
        return Solution(None, inverse, evaluations, norm)

    def _corrected(self, z: Vector, inverse: Matrix, residual: Vector) -> Vector:
        z = z - self.nominal * (inverse @ residual)
        return np.minimum(np.maximum(z, self.lower), self.upper)

    def _try(
        self,
        inverse: Matrix | None,
        evaluate: Evaluate,
        fetch: Callable[[], Vector],
        z: Vector,
        residual: Vector,
    ) -> tuple[Vector, Vector, Matrix | None, int]:
        """Return z, residual and inverse after a correction, or as before a bad one; evaluations.

        That z became worse, or such that a participant refuses it, says only that the guess was
        wrong.
        """
        if inverse is None:
            return z, residual, None, 0
        with np.errstate(over="ignore", invalid="ignore"):
            there = self._corrected(z, inverse, residual)
            if self._runs_away(there) is not None:
                return z, residual, None, 0
        if evaluate(there) is not None:
            return z, residual, None, 1
        left = (fetch() - there) / self.nominal
        norm, norm_before = largest(left), largest(residual)
        if not norm < norm_before:
            return z, residual, None, 1
        good = norm <= good_contraction * norm_before
        return there, left, inverse if good else None, 1

    def _runs_away(self, z: Vector) -> Failure | None:
        scaled = z / self.nominal
        # False for NaN and infinity, too, whatever their place in the vector.
        if float(scaled.dot(scaled)) <= (self.tolerance / rounding) ** 2:
            return None
        worst = int(np.argmax(np.abs(scaled)))
        return Failure(
            Cause.CONVERGENCE,
            f"the coupling iteration ran away: {self.names[worst]} became {z[worst]:.3g}, where "
            f"rounding hides a residual of {self.tolerance:.3g} times its nominal value "
            f"{self.nominal[worst]:.3g}; the loop has no solution or the nominal value is wrong",
        )

    def _difference(
        self, evaluate: Evaluate, fetch: Callable[[], Vector], z: Vector, residual: Vector
    ) -> tuple[Matrix | None, Failure | None]:
        jacobian = np.empty((z.size, z.size))
        for column in range(z.size):
            increment = self.perturbation
            if z[column] + increment * self.nominal[column] > self.upper[column]:
                increment = -increment
            nearby = z.copy()
            nearby[column] += increment * self.nominal[column]
            failure = evaluate(nearby)
            if failure is not None:
                return None, failure
            jacobian[:, column] = ((fetch() - nearby) / self.nominal - residual) / increment
        inverse = invert(jacobian)
        if inverse is not None:
            return inverse, None
        return None, Failure(
            Cause.CONVERGENCE,
            f"the loop through {' and '.join(self.names)} has no single solution, because its "
            "Jacobian is singular",
        )

    def _not_converged(self, z: Vector, residual: Vector, norm: float) -> Failure:
        worst = int(np.argmax(np.abs(residual)))
        bound = self.lower[worst] if residual[worst] < 0.0 else self.upper[worst]
        held = f" (kept at its bound {bound:.6g})" if z[worst] == bound else ""
        return Failure(
            Cause.CONVERGENCE,
            f"the coupling iteration did not converge in {self.max_iterations} corrections: "
            f"{self.names[worst]}{held} is left with {norm:.3g} of its nominal value "
            f"(allowed {self.tolerance:.3g})",
        )


def broyden(inverse: Matrix, moved: Vector, change: Vector) -> Matrix:
    """Return the inverse Jacobian H after a good Broyden update, so that H `change` = `moved`.

    H+ = H + (s - H y) s'H / (s'H y), for the step s = `moved` and the residual's change y.
    """
    projected = inverse @ change
    row = moved @ inverse
    scale = float(row @ change)
    if abs(scale) <= 1e-8 * largest(moved) ** 2:
        return inverse
    updated: Matrix = inverse + ((moved - projected) / scale)[:, None] * row
    return updated


def invert(matrix: Matrix) -> Matrix | None:
    """Return the inverse, or None where there is none that is finite."""
    inverse = np.empty_like(matrix)
    try:
        inverse[...] = np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return None
    return inverse if np.isfinite(inverse).all() else None


def largest(vector: Vector) -> float:
    """Return the largest absolute value of a short vector."""
    return max(map(abs, vector.tolist()), default=0.0)
