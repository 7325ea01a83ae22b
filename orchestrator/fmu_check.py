"""Does an FMU do what it claims? Each claim is tried in processes that may crash."""

import resource
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from fmpy.validation import validate_fmu

from .errors import OrchestratorError, SettingsError
from .fmu import StartValue
from .fmu_trial import Trial, steps
from .isolated import DEFAULT_TIMEOUT

rounds = 500
"""Savings, restorings and releases before the memory is read, and again after that."""

tolerated_growth = 200
"""What a process may grow by, per state [bytes]: allocators take whole pages."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """What came of trying one claim.

    Attributes
    ----------
    claim : str
        What was tried.
    holds : bool or None
        Whether it holds; None when the FMU does not claim it or it cannot be measured here.
    detail : str
        Why, or what was measured.
    """

    claim: str
    holds: bool | None
    detail: str


def check_fmu(
    path: str | Path,
    *,
    step_size: float = 1e-3,
    start_values: Mapping[str, StartValue] | None = None,
    timeout: float = DEFAULT_TIMEOUT,
) -> list[Verdict]:
    """Try what an FMU claims.

    Parameters
    ----------
    path : str or pathlib.Path
        The FMU.
    step_size : float
        Size of the steps to try it with [s].
    start_values : mapping of str to float, int, bool or str, optional
        Values to set before the initialisation.
    timeout : float
        Longest answer to one call [s].

    Returns
    -------
    list of Verdict
        The file itself, repeatability, step sizes, rollback, memory, serialisation.

    Raises
    ------
    FmuError
        When the file is no FMU that can be run at all, or a start value does not fit.
    SettingsError
        When the step size is not positive.
    """
    if not 0.0 < step_size < float("inf"):
        raise SettingsError(f"step_size = {step_size} s must be positive and finite.")
    trial = Trial(Path(path), step_size=step_size, start_values=start_values or {}, timeout=timeout)
    fmu = trial.described
    saves, serialises = fmu.can_save_state, fmu.can_save_state and fmu.can_serialise_state
    verdicts = [_validate(Path(path))]
    for claim, claimed, check in (
        ("two instances give the same results", True, _repeat),
        ("steps may differ in size", fmu.can_vary_step, _vary),
        ("a saved state is restored completely", saves, _roll_back),
        ("saved states are freed", saves, _leak),
        ("a state goes over into a fresh process", serialises, _serialise),
    ):
        if not claimed:
            verdicts.append(Verdict(claim=claim, holds=None, detail="not claimed"))
            continue
        verdicts.append(_try(claim, check, trial))
    return verdicts


Check = Callable[[Trial], tuple[bool | None, str]]


def _try(claim: str, check: Check, trial: Trial) -> Verdict:
    try:
        holds, detail = check(trial)
    except OrchestratorError as error:
        holds, detail = False, str(error)
    return Verdict(claim=claim, holds=holds, detail=detail)


def _validate(path: Path) -> Verdict:
    problems = [" ".join(str(item).split()) for item in validate_fmu(str(path))]
    return Verdict(
        claim="the file keeps to the standard",
        holds=not problems,
        detail="; ".join(problems[:3]) or "no problem found",
    )


def _repeat(trial: Trial) -> tuple[bool, str]:
    sizes = [trial.step_size] * steps
    with trial.started() as first, trial.started() as second:
        return trial.compare(trial.advance(first, sizes), trial.advance(second, sizes))


def _vary(trial: Trial) -> tuple[bool, str]:
    h = trial.step_size
    sizes = [h, h / 2, h / 3, h, h / 1000, h / 7] * (steps // 6)
    with trial.started() as participant:
        trial.advance(participant, sizes)
    return True, f"{len(sizes)} steps from {min(sizes):.3g} s to {h:.3g} s were accepted"


def _roll_back(trial: Trial) -> tuple[bool, str]:
    sizes = [trial.step_size] * steps
    with trial.started() as participant:
        trial.advance(participant, sizes)
        state, time = participant.save(), steps * trial.step_size
        first = trial.advance(participant, sizes, time)
        trial.advance(participant, sizes[:3], 2.0 * time)
        participant.restore(state)
        return trial.compare(first, trial.advance(participant, sizes, time))


def _serialise(trial: Trial) -> tuple[bool, str]:
    sizes, time = [trial.step_size] * steps, steps * trial.step_size
    with trial.started() as first, trial.started() as second:
        trial.advance(first, sizes)
        state = first.save()
        data = first.serialise(state)
        expected = trial.advance(first, sizes, time)
        second.restore(second.deserialise(data))
        return trial.compare(expected, trial.advance(second, sizes, time))


def _leak(trial: Trial) -> tuple[bool | None, str]:
    sizes = [trial.step_size] * 2
    used = []
    with trial.started() as participant:
        for part in range(3):
            for _ in range(rounds):
                state = participant.save()
                participant.restore(state)
                participant.release(state)
            trial.advance(participant, sizes, part * sum(sizes))
            used.append(_resident(participant.process))
    if not all(used):
        return None, "this system does not tell the memory of a process"
    growth = (used[2] - used[1]) / rounds
    return growth <= tolerated_growth, f"{growth:.0f} bytes per state over {rounds} states"


def _resident(process: int | None) -> int:
    """Return the memory of a process [bytes], or 0 where the system does not tell."""
    table = Path(f"/proc/{process}/statm")
    if not table.exists():
        return 0
    return int(table.read_text(encoding="ascii").split()[1]) * resource.getpagesize()
