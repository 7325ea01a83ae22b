"""An FMI 2.0 co-simulation FMU as a participant."""

import logging
from collections.abc import Mapping, Sequence
from ctypes import byref, c_char, c_double, c_int, c_size_t, c_void_p, create_string_buffer
from pathlib import Path

from fmpy.fmi2 import fmi2LastSuccessfulTime

from .described import DescribedFmu
from .errors import ParticipantError
from .fixed_call import fixed_call, untyped
from .fmu_description import StartValue
from .fmu_instance import FmuInstance
from .fmu_log import FmuLog
from .fmu_values import DirectionalDerivatives, Reader, Writer, write_start_values
from .participant import OK, InputShape, Matrix, Status, StatusKind, Vector

logger = logging.getLogger(__name__)

linear_inputs = "linear_inputs"
"""Boolean parameter of FMUs that can take their inputs as straight lines over the step."""


class FmuParticipant(DescribedFmu):
    """Participant that drives an FMU through fmpy's raw functions.

    The file is read and checked at once; it is unpacked and loaded by `instantiate`.

    Parameters
    ----------
    path : str or pathlib.Path
        The FMU.
    name : str, optional
        Name in the system; the model name by default.
    start_values : mapping of str to float, int, bool or str, optional
        Values to set before the initialisation.

    Raises
    ------
    FmuError
        When the file or a start value is not usable.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        name: str | None = None,
        start_values: Mapping[str, StartValue] | None = None,
    ) -> None:
        super().__init__(path)
        self._start_values = dict(start_values or {})
        self._description.check_start_values(self._start_values)
        self.name = name if name is not None else self._description.model_name
        self.input_shape: InputShape = "held"
        self._log = FmuLog()
        self._bound: tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]] = ((), (), ())
        self._instance: FmuInstance | None = None
        self._shape_values: dict[str, StartValue] = {}
        self._when: tuple[float | None, float | None] = (None, None)

    @property
    def messages(self) -> Sequence[str]:
        """What it logged last, oldest first."""
        return tuple(self._log.messages)

    def bind(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        """Fix the variables exchanged; take inputs as straight lines if it can and should."""
        self._bound = (tuple(inputs), tuple(outputs), tuple(observed))
        flag = self.variables.get(linear_inputs)
        self._shape_values = {}
        if flag is not None and flag.type == "Boolean":
            self._shape_values[linear_inputs] = input_shape == "linear"
        wanted = {**self._shape_values, **self._start_values}.get(linear_inputs, False)
        self.input_shape = "linear" if wanted else "held"
        logger.info("%s takes its inputs %s over a step", self.name, self.input_shape)

    def instantiate(self) -> None:
        """Unpack and load the FMU, create the instance and set the start values."""
        self._when = (None, None)
        self._log.messages.clear()
        description = self._description
        try:
            instance = FmuInstance(description, self.name, self._log)
        except OSError as error:
            raise self._error(f"it could not be loaded ({error})") from error
        self._instance = instance
        self._component = instance.component
        functions = instance.functions
        self._time, self._step_size = c_double(), c_double()
        self._do_step = fixed_call(
            functions["fmi2DoStep"], self._component, self._time, self._step_size, c_int()
        )
        self._get_state = untyped(functions["fmi2GetFMUstate"])
        self._set_state = untyped(functions["fmi2SetFMUstate"])
        self._free_state = untyped(functions["fmi2FreeFMUstate"])
        name, status = write_start_values(
            functions, self._component, description, {**self._shape_values, **self._start_values}
        )
        self._require(f"setting the start value of {name}", status)
        inputs, outputs, observed = self._bound
        self._writer = Writer(functions, self._component, description, inputs)
        self._outputs = Reader(functions, self._component, description, outputs)
        self._observed = Reader(functions, self._component, description, observed)
        self._derivatives = DirectionalDerivatives(
            functions, self._component, description, inputs=inputs, outputs=outputs
        )

    def enter_initialisation(
        self, *, start_time: float, stop_time: float, tolerance: float | None
    ) -> None:
        """Set up the experiment [s] and enter the initialisation mode."""
        self._call(
            "fmi2SetupExperiment",
            int(tolerance is not None),
            tolerance or 0.0,
            start_time,
            1,
            stop_time,
        )
        self._call("fmi2EnterInitializationMode")

    def exit_initialisation(self) -> None:
        """Leave the initialisation mode."""
        self._call("fmi2ExitInitializationMode")

    def set_inputs(self, values: Vector) -> Status:
        """Set the bound inputs, shape (n_inputs,)."""
        status = self._writer.write(values)
        return OK if status < 2 else self._answer("setting its inputs", status)

    def get_outputs(self, out: Vector) -> Status:
        """Write the bound outputs to `out`, shape (n_outputs,)."""
        status = self._outputs.read(out)
        return OK if status < 2 else self._answer("reading its outputs", status)

    def get_observed(self, out: Vector) -> Status:
        """Write the observed values to `out`, shape (n_observed,)."""
        status = self._observed.read(out)
        return OK if status < 2 else self._answer("reading its observed values", status)

    def directional_derivatives(self, out: Matrix) -> Status:
        """Write what each output gains with each input, shape (n_outputs, n_inputs)."""
        status = self._derivatives.read(out)
        return OK if status < 2 else self._answer("reading its directional derivatives", status)

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        self._when = (time, step_size)
        self._time.value, self._step_size.value = time, step_size
        status = self._do_step()
        if status < 2:
            return OK
        answer = self._answer("the step", status)
        if answer.kind is StatusKind.DISCARD:
            return answer._replace(last_successful_time=self._last_successful_time(time))
        return answer

    def save(self) -> object:
        """Return a new handle of the complete present state."""
        state = c_void_p()
        status = self._get_state(self._component, byref(state))
        if status > 1:
            self._require("fmi2GetFMUstate", status)
        return state

    def restore(self, state: object) -> None:
        """Go back to `state`."""
        status = self._set_state(self._component, state)
        if status > 1:
            self._require("going back to a saved state", status)

    def release(self, state: object) -> None:
        """Give up `state`, unless the instance is dead and must not be called."""
        if self._instance is not None and not self._instance.dead:
            assert isinstance(state, c_void_p)
            status = self._free_state(self._component, byref(state))
            if status > 1:
                self._require("fmi2FreeFMUstate", status)

    def serialise(self, state: object) -> bytes:
        """Return `state` as bytes."""
        size = c_size_t()
        self._call("fmi2SerializedFMUstateSize", state, byref(size))
        buffer = create_string_buffer(size.value)
        self._call("fmi2SerializeFMUstate", state, buffer, size)
        return buffer.raw

    def deserialise(self, data: bytes) -> object:
        """Return a new handle of the state in `data`."""
        state = c_void_p()
        buffer = (c_char * len(data)).from_buffer_copy(data)
        self._call("fmi2DeSerializeFMUstate", buffer, len(data), byref(state))
        return state

    def terminate(self) -> None:
        """End the simulation in order."""
        self._call("fmi2Terminate")

    def free(self) -> None:
        """Free instance, library and folder; harmless when repeated."""
        instance, self._instance = self._instance, None
        if instance is not None:
            instance.free()

    def _call(self, function: str, *arguments: object) -> None:
        assert self._instance is not None, "instantiate comes first"
        self._require(function, self._instance.functions[function](self._component, *arguments))

    def _require(self, what: str, status: int) -> None:
        if status > 1:
            raise self._error(self._answer(what, status).message)

    def _answer(self, what: str, status: int) -> Status:
        assert self._instance is not None, "instantiate comes first"
        return self._instance.answer(what, status)

    def _last_successful_time(self, start: float) -> float | None:
        assert self._instance is not None, "instantiate comes first"
        value = c_double()
        status = self._instance.functions["fmi2GetRealStatus"](
            self._component, fmi2LastSuccessfulTime, byref(value)
        )
        return value.value if status < 2 and value.value > start else None

    def _error(self, failure: str) -> ParticipantError:
        time, step_size = self._when
        inputs = (
            dict(zip(self._bound[0], self._writer.last(), strict=True))
            if time is not None
            else None
        )
        return ParticipantError(
            participant=self.name,
            failure=failure,
            time=time,
            step_size=step_size,
            inputs=inputs,
            messages=self.messages,
        )
