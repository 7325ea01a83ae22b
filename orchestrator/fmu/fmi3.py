"""FMI 3.0 for co-simulation: how an instance is created and stepped."""

from ctypes import byref, c_bool, c_double, c_uint8
from typing import Any

from fmpy.fmi3 import FMU3Slave

from ..participant import OK, Status, StatusKind
from .description import FmuDescription
from .fixed_call import fixed_call
from .instance import Call, FmuInstance, asks_for_the_end
from .log import FmuLog
from .states import StateFunctions

whole_step = 1e-9
"""Part of a step that may be missing when it counts as whole."""


class Fmi3Instance(FmuInstance):
    """An instance of an FMI 3.0 FMU; see `FmuInstance`.

    Event mode is not used: the FMU handles its events itself within a step. It may return early
    from one if it can go back, since the step is then repeated up to there by all participants.
    """

    prefix = "fmi3"
    state_functions = StateFunctions(
        get="fmi3GetFMUState",
        set="fmi3SetFMUState",
        free="fmi3FreeFMUState",
        size="fmi3SerializedFMUStateSize",
        serialise="fmi3SerializeFMUState",
        deserialise="fmi3DeserializeFMUState",
        byte=c_uint8,
    )

    def __init__(self, description: FmuDescription, name: str, log: FmuLog) -> None:
        super().__init__(description, name, log)
        self._event, self._over, self._early = c_bool(), c_bool(), c_bool()
        self._time, self._step_size, self._reached = c_double(), c_double(), c_double()
        ends = (byref(item) for item in (self._event, self._over, self._early, self._reached))
        self._do_step = fixed_call(
            self.functions["fmi3DoStep"],
            self.component,
            self._time,
            self._step_size,
            c_bool(),
            *ends,
        )

    def _load(self, **arguments: str) -> Any:  # noqa: ANN401 - fmpy carries no types
        return FMU3Slave(**arguments)

    def _start(self, description: FmuDescription, log: FmuLog) -> None:
        def keep(
            _environment: int | None, status: int, _category: bytes | None, message: bytes | None
        ) -> None:
            log.keep(status, message)

        self._slave.instantiate(
            loggingOn=True, earlyReturnAllowed=description.can_save_state, logMessage=keep
        )

    def opening(self, start: float, stop: float, tolerance: float | None) -> list[Call]:
        """Return the calls that begin the initialisation, times in s."""
        experiment = (tolerance is not None, tolerance or 0.0, start, True, stop)
        return [("fmi3EnterInitializationMode", experiment)]

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        self._time.value, self._step_size.value = time, step_size
        self._reached.value = time
        status = self._do_step()
        if status < 2 and not self._early.value and not self._over.value:
            return OK
        return self._not_whole(status, time, step_size)

    def _not_whole(self, status: int, time: float, step_size: float) -> Status:
        answer = OK if status < 2 else self.answer("the step", status)
        if answer.kind not in {StatusKind.OK, StatusKind.DISCARD}:
            return answer
        reached = self._reached.value
        if self._over.value:
            return asks_for_the_end(reached)
        missing = time + step_size - reached
        if answer is OK:
            if missing <= whole_step * step_size:
                return OK
            answer = Status(StatusKind.EARLY, f"the step ended early, at {reached:.9g} s")
        if reached > time:
            return answer._replace(last_successful_time=reached)
        return answer._replace(kind=StatusKind.DISCARD)
