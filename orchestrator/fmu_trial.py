"""An FMU in processes of its own, taken through steps whose results can be compared."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from .errors import ParticipantError
from .fmu import StartValue
from .isolated import IsolatedParticipant
from .participant import OK, Vector

steps = 20
"""Steps of a trial."""

disturbance = 1e-3
"""Change of the inputs about their start values, over their nominal values."""


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
        self._start = np.zeros(len(self._inputs))

    def _make(self) -> IsolatedParticipant:
        return IsolatedParticipant(
            self._path, start_values=self._start_values, timeout=self._timeout
        )

    @contextmanager
    def started(self) -> Iterator[IsolatedParticipant]:
        """Give a participant at the beginning of its first step, in a new process."""
        participant = self._make()
        names = [variable.name for variable in self._inputs]
        participant.bind(
            inputs=names, outputs=[], observed=[*names, *self.outputs], input_shape="held"
        )
        try:
            participant.instantiate()
            participant.enter_initialisation(
                start_time=0.0, stop_time=1e3 * steps * self.step_size, tolerance=None
            )
            participant.exit_initialisation()
            self._start = self._inputs_of(participant)
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
        """Make steps of these sizes [s] from `time`, and return all outputs after each of them.

        The inputs stay near their start values, since no FMU has to take any others.
        """
        nominal = np.array([variable.nominal or 1.0 for variable in self._inputs])
        lower = np.array([variable.minimum for variable in self._inputs])
        upper = np.array([variable.maximum for variable in self._inputs])
        seen, values = [], np.empty(len(self._inputs) + len(self.outputs))
        out = values[len(self._inputs) :]
        for size in sizes:
            wave = disturbance * np.sin(1.0 + time / self.step_size)
            status = participant.set_inputs(np.clip(self._start + wave * nominal, lower, upper))
            if status is OK:
                status = participant.step(time, size)
            if status is OK:
                status = participant.get_observed(values)
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

    def _inputs_of(self, participant: IsolatedParticipant) -> Vector:
        """Return what a participant has for its inputs."""
        values = np.empty(len(self._inputs) + len(self.outputs))
        status = participant.get_observed(values)
        if status is not OK:
            raise ParticipantError(
                participant=participant.name,
                failure=status.message,
                messages=participant.messages,
            )
        return values[: len(self._inputs)].copy()

    def compare(self, first: bytes, second: bytes) -> tuple[bool, str]:
        """Say whether two runs gave the same bits, and where they differ if they do not."""
        if first == second:
            return True, f"{len(first) // 8} values are the same bit for bit"
        values = [np.frombuffer(data).reshape(-1, len(self.outputs)) for data in (first, second)]
        bits = [item.view(np.int64) for item in values]
        step, column = (int(n) for n in np.argwhere(bits[0] != bits[1])[0])
        one, other = (float(item[step, column]) for item in values)
        return False, f"{self.outputs[column]} is {one!r} and then {other!r} after step {step + 1}"
