"""FMI 2.0 for co-simulation: how an instance is created and stepped."""

from ctypes import byref, c_char, c_double, c_int, c_void_p, cast
from typing import Any

from fmpy import calloc, free
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
)

from ..participant import OK, Status, StatusKind
from .description import FmuDescription
from .fixed_call import fixed_call
from .instance import Call, FmuInstance, asks_for_the_end
from .log import FmuLog
from .states import StateFunctions


class Fmi2Instance(FmuInstance):
    """An instance of an FMI 2.0 FMU; see `FmuInstance`."""

    prefix = "fmi2"
    state_functions = StateFunctions(
        get="fmi2GetFMUstate",
        set="fmi2SetFMUstate",
        free="fmi2FreeFMUstate",
        size="fmi2SerializedFMUstateSize",
        serialise="fmi2SerializeFMUstate",
        deserialise="fmi2DeSerializeFMUstate",
        byte=c_char,
    )

    def __init__(self, description: FmuDescription, name: str, log: FmuLog) -> None:
        super().__init__(description, name, log)
        self._time, self._step_size = c_double(), c_double()
        self._do_step = fixed_call(
            self.functions["fmi2DoStep"], self.component, self._time, self._step_size, c_int()
        )

    def _load(self, **arguments: str) -> Any:  # noqa: ANN401 - fmpy carries no types
        return FMU2Slave(**arguments)

    def _start(self, description: FmuDescription, log: FmuLog) -> None:
        del description
        self._callbacks = _callbacks(log)  # must live as long as the instance
        self._slave.instantiate(callbacks=self._callbacks, loggingOn=True)

    def opening(self, start: float, stop: float, tolerance: float | None) -> list[Call]:
        """Return the calls that begin the initialisation, times in s."""
        experiment = (int(tolerance is not None), tolerance or 0.0, start, 1, stop)
        return [("fmi2SetupExperiment", experiment), ("fmi2EnterInitializationMode", ())]

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        self._time.value, self._step_size.value = time, step_size
        status = self._do_step()
        if status < 2:
            return OK
        answer = self.answer("the step", status)
        if answer.kind is not StatusKind.DISCARD:
            return answer
        reached, over = c_double(time), c_int(0)
        if not self._ask("Real", fmi2LastSuccessfulTime, reached) or not reached.value > time:
            # Exporters set fmi2Terminated with every step that they refuse, cppfmu for one, and
            # with it pythonfmu: without progress it says no more than fmi2Discard.
            return answer
        if self._ask("Boolean", fmi2Terminated, over) and over.value:
            return asks_for_the_end(reached.value)
        return answer._replace(last_successful_time=reached.value)

    def _ask(self, kind: str, what: int, value: c_double | c_int) -> bool:
        function = self.functions[f"fmi2Get{kind}Status"]
        return bool(function(self.component, what, byref(value)) < 2)


def _callbacks(log: FmuLog) -> Any:  # noqa: ANN401 - fmpy carries no types
    """Return the callback functions of one instance, with a logger that keeps the messages.

    The logger of FMI 2.0 takes printf arguments, which Python callbacks cannot receive. fmpy's
    native formatter can, but serves one logger per process and would read past the end of messages
    with a per cent sign in them, so that messages are kept as they are.
    """

    def keep(
        _environment: int | None,
        _instance: bytes | None,
        status: int,
        _category: bytes | None,
        message: bytes | None,
    ) -> None:
        log.keep(status, message)

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(keep)
    allocate, release = cast(calloc, c_void_p).value, cast(free, c_void_p).value
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(allocate)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(release)
    return callbacks
