"""Contact forces at the end of a step, at which wheels, contacts and track agree.

With the wheels' levels given, a compression is what remains of a level over the rail:

    delta = level - u(F, g),   F = law(delta),   g = demanded(F, g)

where the rail displacement ``u`` is affine in the contact forces and in the increments ``g`` of the
state-dependent components. Newton's iteration on the compressions and the increments at once takes
the exact tangents of the contacts and those of the increments at the start of the step, or where
they are if their laws are stiff.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .answer import Answer
from .beam_element import FloatArray
from .contact_law import ContactLaw
from .step_operator import StepOperator

RELATIVE_TOLERANCE = 1e-13
ABSOLUTE_TOLERANCE = 1e-8  # N; a hundred times the rounding of millimetres, times `STIFFNESS`
STIFFNESS = 1e9  # N/m, of a loaded contact; it makes compressions comparable with forces
MAX_ITERATIONS = 60
MAX_HALVINGS = 6


class ContactSolution(NamedTuple):
    """Where wheels, contacts and track agree.

    Attributes
    ----------
    compression, force : (wheels,) float array
        Of the contacts [m], [N]; the compression is minus the gap where a wheel is off.
    increment : (components,) float array
        Force increments of the active components [N].
    """

    compression: FloatArray
    force: FloatArray
    increment: FloatArray


class _Miss(NamedTuple):
    """What a trial misses: compressions [m], increments [N], and both together [N]."""

    compression: FloatArray
    increment: FloatArray
    norm: float


def solve_contact(
    operator: StepOperator,
    law: ContactLaw,
    *,
    level: FloatArray,
    compression: FloatArray,
) -> ContactSolution:
    """Find the contact forces at the end of a step.

    Parameters
    ----------
    operator : StepOperator
        The step.
    law : ContactLaw
        Of the contacts.
    level : (wheels,) float array
        What the wheels' treads would indent an undeformed rail there [m].
    compression : (wheels,) float array
        First guess [m]; the increments are first guessed as they were before the step.

    Raises
    ------
    RuntimeError
        If the iteration does not converge.
    """
    trial = ContactSolution(compression, law.force(compression), operator.increments.first)
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused below
        miss = _miss(operator, trial, level)
        for _ in range(MAX_ITERATIONS):
            answer = operator.answer_at(trial.force, trial.increment)
            change, increment_change = _newton_change(answer, law, trial, miss)
            share = 1.0
            for _ in range(MAX_HALVINGS):
                new = _moved(law, trial, share * change, share * increment_change)
                new_miss = _miss(operator, new, level)
                if new_miss.norm <= miss.norm:
                    break
                share *= 0.5
            if not np.isfinite(new_miss.norm):
                break
            moved = _size(new.compression - trial.compression, new.increment - trial.increment)
            scale = float(np.max(new.force)) + float(np.max(np.abs(new.increment), initial=0.0))
            trial, miss = new, new_miss
            if moved <= RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE:
                return trial
    raise RuntimeError(
        f"track: the contact forces did not converge in {MAX_ITERATIONS} iterations over a step of "
        f"{operator.step_size:.3g} s at wheel levels of {', '.join(f'{z:.6g}' for z in level)} m; "
        "use a shorter step"
    )


def _newton_change(
    answer: Answer, law: ContactLaw, trial: ContactSolution, miss: _Miss
) -> tuple[FloatArray, FloatArray]:
    """Newton's change of compressions [m] and increments [N]."""
    stiffness = law.stiffness(trial.compression)
    matrix = np.eye(len(stiffness)) + answer.displacement * stiffness
    wanted = miss.compression + answer.relief @ miss.increment
    change = np.asarray(np.linalg.solve(matrix, wanted))
    follow = answer.correction @ miss.increment + answer.increments @ (stiffness * change)
    return change, follow


def _moved(
    law: ContactLaw, trial: ContactSolution, change: FloatArray, increment_change: FloatArray
) -> ContactSolution:
    compression = trial.compression + change
    return ContactSolution(compression, law.force(compression), trial.increment + increment_change)


def _miss(operator: StepOperator, trial: ContactSolution, level: FloatArray) -> _Miss:
    compression = level - operator.displacement(trial.force, trial.increment) - trial.compression
    increment = operator.increments.demanded(trial.force, trial.increment) - trial.increment
    return _Miss(compression, increment, _size(compression, increment))


def _size(compression: FloatArray, increment: FloatArray) -> float:
    """One measure of compressions [m] and increments [N], in newtons."""
    largest = float(np.max(np.abs(increment), initial=0.0))
    return STIFFNESS * float(np.max(np.abs(compression))) + largest
