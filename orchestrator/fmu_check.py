"""Does an FMU do what it claims? Each claim is tried in processes that may crash."""

import resource
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy.validation import validate_fmu

from .errors import OrchestratorError, ParticipantError, SettingsError
from .fmu import StartValue
from .isolated import DEFAULT_TIMEOUT, IsolatedParticipant
from .participant import OK

steps = 20
"""Steps of a trial."""

disturbance = 1e-3
"""Change of the inputs from step to step, over their nominal values."""

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


class Trial:
    """Runs an FMU through steps with inputs that vary, from one start.

    Parameters
    ----------
    path : pathlib.Path
        The FMU.
    step_size : float
        Size of its steps [s].
    start_values : mapping of str to float, int, bool or str
        Values to set before the initialisation.
    timeout : float
        Longest answer to one call [s].
    """

    def __init__(
        self,
        path: Path,
        *,
        step_size: float,
        start_values: Mapping[str, StartValue],
        timeout: float,
    ) -> None:
        self.step_size = step_size
        self._path, self._start_values, self._timeout = path, start_values, timeout
        self.described = self._make()
        items = self.described.variables.values()
        self._inputs = [v for v in items if v.causality == "input" and v.type == "Real"]
        self.outputs = [v.name for v in items if v.causality == "output" and v.type != "String"]

    def _make(self) -> IsolatedParticipant:
        return IsolatedParticipant(
            self._path, start_values=self._start_values, timeout=self._timeout
        )

    @contextmanager
    def started(self) -> Iterator[IsolatedParticipant]:
        """Give a participant at the beginning of its first step, in a new process."""
        participant = self._make()
        names = [variable.name for variable in self._inputs]
        participant.bind(inputs=names, outputs=[], observed=self.outputs, input_shape="held")
        try:
            participant.instantiate()
            participant.enter_initialisation(
                start_time=0.0, stop_time=1e3 * steps * self.step_size, tolerance=None
            )
            participant.exit_initialisation()
            yield participant
            if participant.incidents:
                raise ParticipantError(
                    participant=participant.name, failure=participant.incidents[0].rstrip(".")
                )
        finally:
            participant.free()

    def advance(
        self, participant: IsolatedParticipant, sizes: Sequence[float], time: float = 0.0
    ) -> bytes:
        """Make steps of these sizes [s] from `time`, and return all outputs after each of them."""
        nominal = np.array([variable.nominal or 1.0 for variable in self._inputs])
        lower = np.array([variable.minimum for variable in self._inputs])
        upper = np.array([variable.maximum for variable in self._inputs])
        seen, out = [], np.empty(len(self.outputs))
        for size in sizes:
            wave = disturbance * np.sin(1.0 + time / self.step_size)
            status = participant.set_inputs(np.clip(wave * nominal, lower, upper))
            if status is OK:
                status = participant.step(time, size)
            if status is OK:
                status = participant.get_observed(out)
            failure = status.message
            if status is OK and not np.isfinite(out).all():
                name = self.outputs[int(np.argmin(np.isfinite(out)))]
                failure = f"its value of {name} is not finite"
            if failure:
                raise ParticipantError(
                    participant=participant.name,
                    failure=failure,
                    time=time,
                    step_size=size,
                    messages=participant.messages,
                )
            seen.append(out.tobytes())
            time += size
        return b"".join(seen)

    def compare(self, first: bytes, second: bytes) -> tuple[bool, str]:
        """Say whether two runs gave the same bits, and where they differ if they do not."""
        if first == second:
            return True, f"{len(first) // 8} values are the same bit for bit"
        values = [np.frombuffer(data).reshape(-1, len(self.outputs)) for data in (first, second)]
        bits = [item.view(np.int64) for item in values]
        step, column = (int(n) for n in np.argwhere(bits[0] != bits[1])[0])
        one, other = (float(item[step, column]) for item in values)
        return False, f"{self.outputs[column]} is {one!r} and then {other!r} after step {step + 1}"


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
