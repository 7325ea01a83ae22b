"""Who can go back to a saved state, and whether it is true."""

import logging
from collections.abc import Sequence

import numpy as np

from .decision import Failure
from .errors import RollbackError
from .participant import Participant, StatusKind, Vector
from .stage import Stage
from .system import System

logger = logging.getLogger(__name__)

halvings = 5
"""How often a step that is refused is halved before the check is given up."""

disturbance = 1e-3
"""Change of the inputs between the two passes of the check, over their nominal values."""


def place_without_rollback(system: System, *, delay_allowed: bool) -> int | None:
    """Return the place of the participant that cannot go back, if there is one.

    Parameters
    ----------
    system : System
        Participants and connections.
    delay_allowed : bool
        Whether others may step with values from the past where it drives them.

    Raises
    ------
    RollbackError
        When there are several, or when it drives others that need its values of the same step.
    """
    without = [n for n, item in enumerate(system.participants) if not item.can_save_state]
    if not without:
        return None
    names = [system.participants[place].name for place in without]
    if len(without) > 1:
        raise RollbackError(
            f"{' and '.join(names)} cannot save their states, but only one participant may: it "
            "steps once, after all others; use an explicit algorithm with a fixed_step and without "
            "min_step."
        )
    name = names[0]
    driven = [item for item in system.connections if item.source.partition(".")[0] == name]
    if driven and not delay_allowed:
        raise RollbackError(
            f"{name} cannot save its state, so it can step only once and last, but "
            f"{driven[0].source} drives {driven[0].target} within the same step; "
            "use an explicit algorithm with a fixed step."
        )
    return without[0]


def check_rollback(stages: Sequence[Stage], time: float, step_size: float) -> list[str]:
    """Let every stage step, wander off, go back and step again, and compare the two steps.

    Parameters
    ----------
    stages : sequence of Stage
        Those that claim to be able to go back; they are left as they were.
    time, step_size : float
        Step to make [s].

    Returns
    -------
    list of str
        A sentence about each stage whose steps failed, so that nothing is known about it.

    Raises
    ------
    RollbackError
        When the outputs of the two steps are not the same bit for bit.
    """
    warnings = []
    for stage in stages:
        outputs = stage.outputs.copy()
        stage.save()
        try:
            obstacle = _check(stage, time, step_size)
        finally:
            stage.release()
            stage.outputs[:] = outputs
        if obstacle is not None:
            warnings.append(
                f"Whether {stage.participant.name} restores saved states could not be checked: "
                f"{obstacle.message}"
            )
            logger.warning("%s", warnings[-1])
    return warnings


def _check(stage: Stage, time: float, step_size: float) -> Failure | None:
    participant = stage.participant
    failure = stage.step(time, step_size)
    for _ in range(halvings):
        if failure is not None and participant.can_vary_step:
            step_size *= 0.5
            failure = stage.step(time, step_size)
    if failure is not None:
        stage.go_back()
        return failure
    stage.read_observed(time, step_size)
    first = np.concatenate([stage.outputs, stage.observed])
    for status in (
        participant.set_inputs(
            _disturbed(participant, stage.input_names, stage.converted_inputs())
        ),
        participant.step(time + step_size, step_size),
    ):
        if status.kind is StatusKind.FATAL:
            raise stage.error(status.message, time + step_size, step_size)
    failure = stage.step(time, step_size)
    if failure is not None:
        raise RollbackError(
            f"{participant.name} claims to restore saved states but does not: a step from "
            f"t = {time:.9g} s worked, and failed when it was repeated ({failure.message})."
        )
    stage.read_observed(time, step_size)
    second = np.concatenate([stage.outputs, stage.observed])
    differing = np.flatnonzero(first.view(np.int64) != second.view(np.int64))
    if differing.size:
        names = (*stage.output_names, *stage.observed_names)
        place = int(differing[0])
        raise RollbackError(
            f"{participant.name} claims to restore saved states but does not: "
            f"{names[place]} after a step of {step_size:.6g} s from t = {time:.9g} s was "
            f"{float(first[place])!r}, and {float(second[place])!r} when it was repeated; some of "
            "its state stays behind, or it answers the same calls in different ways."
        )
    stage.go_back()
    return None


def _disturbed(participant: Participant, names: Sequence[str], inputs: Vector) -> Vector:
    variables = [participant.variables[name] for name in names]
    nominal = np.array([variable.nominal or 1.0 for variable in variables])
    lower = np.array([variable.minimum for variable in variables])
    upper = np.array([variable.maximum for variable in variables])
    changed: Vector = np.clip(inputs + disturbance * nominal, lower, upper)
    return changed
