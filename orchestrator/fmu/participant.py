"""An FMI 2.0 or 3.0 co-simulation FMU as a participant."""

import logging
from collections.abc import Mapping, Sequence
from ctypes import byref, c_void_p
from pathlib import Path

from ..errors import ParticipantError
from ..participant import OK, InputShape, Matrix, Status, Vector
from .derivatives import DirectionalDerivatives
from .described import DescribedFmu
from .description import StartValue
from .fixed_call import untyped
from .fmi2 import Fmi2Instance
from .fmi3 import Fmi3Instance
from .input_slopes import InputSlopes
from .input_way import InputWay, choose_input_way
from .instance import FmuInstance
from .log import FmuLog
from .start_values import write_start_values
from .states import State, deserialise, serialise
from .values import Reader, Target, Writer

logger = logging.getLogger(__name__)

versions: Mapping[int, type[FmuInstance]] = {2: Fmi2Instance, 3: Fmi3Instance}


class FmuParticipant(DescribedFmu):
    """Participant that drives an FMU, of whichever version, through fmpy's raw functions.

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
        self._input_way = InputWay()
        self._slopes: InputSlopes | None = None
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
        """Fix the variables exchanged; take inputs as straight lines if it can and should.

        It can by the derivatives of FMI 2.0, else by the parameter ``linear_inputs``.
        """
        self._bound = (tuple(inputs), tuple(outputs), tuple(observed))
        way = choose_input_way(self._description, self._start_values, inputs, wish=input_shape)
        self._input_way = way
        self.input_shape = way.shape
        logger.info("%s takes its inputs over a step %s", self.name, way.words)
        for variable, reason in self._description.left_out.items():
            logger.info("%s.%s is left out, because it is %s", self.name, variable, reason)

    def instantiate(self) -> None:
        """Unpack and load the FMU, create the instance and set the start values."""
        self._when = (None, None)
        self._log.messages.clear()
        description = self._description
        try:
            instance = versions[description.fmi_version](description, self.name, self._log)
        except OSError as error:
            raise self._error(f"it could not be loaded ({error})") from error
        self._instance = instance
        target = Target(instance.functions, instance.component, description)
        given = {**self._input_way.start_values, **self._start_values}
        name, status = write_start_values(target, given)
        self._require(f"setting the start value of {name}", status)
        inputs, outputs, observed = self._bound
        writer = Writer(target, inputs, given)
        self._write, self._last_inputs = writer.write, writer.last
        self._read_outputs = Reader(target, outputs).read
        self._read_observed = Reader(target, observed).read
        self._derivatives = DirectionalDerivatives(target, inputs=inputs, outputs=outputs)
        self._advance = instance.step
        names = instance.state_functions
        self._get_state, self._set_state, self._free_state = (
            untyped(instance.functions[function]) for function in (names.get, names.set, names.free)
        )
        self._component = instance.component
        self._slopes = None
        if self._input_way.uses_slopes:
            self._slopes = InputSlopes(target, inputs, given, observed=observed)

    def enter_initialisation(
        self, *, start_time: float, stop_time: float, tolerance: float | None
    ) -> None:
        """Set up the experiment [s] and enter the initialisation mode."""
        for function, arguments in self._alive.opening(start_time, stop_time, tolerance):
            self._call(function, *arguments)

    def exit_initialisation(self) -> None:
        """Leave the initialisation mode."""
        if self._slopes is not None:
            self._require("reading its inputs", self._slopes.begin())
            self._write, self._last_inputs = self._slopes.aim, self._slopes.last
            self._advance = self._advance_on_slopes
            self._read_observed = self._slopes.read_observed
        self._call(f"{self._alive.prefix}ExitInitializationMode")

    def set_inputs(self, values: Vector) -> Status:
        """Set the bound inputs, shape (n_inputs,)."""
        status = self._write(values)
        return OK if status < 2 else self._alive.answer("setting its inputs", status)

    def get_outputs(self, out: Vector) -> Status:
        """Write the bound outputs to `out`, shape (n_outputs,)."""
        status = self._read_outputs(out)
        return OK if status < 2 else self._alive.answer("reading its outputs", status)

    def get_observed(self, out: Vector) -> Status:
        """Write the observed values to `out`, shape (n_observed,)."""
        status = self._read_observed(out)
        return OK if status < 2 else self._alive.answer("reading its observed values", status)

    def directional_derivatives(self, out: Matrix) -> Status:
        """Write what each output gains with each input, shape (n_outputs, n_inputs)."""
        status = self._derivatives.read(out)
        return OK if status < 2 else self._alive.answer("reading its derivatives", status)

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        self._when = (time, step_size)
        return self._advance(time, step_size)

    def save(self) -> object:
        """Return a new handle of the complete present state."""
        handle = c_void_p()
        self._call(self._alive.state_functions.get, byref(handle))
        return State(handle, None if self._slopes is None else self._slopes.points)

    def restore(self, state: object) -> None:
        """Go back to `state`."""
        assert isinstance(state, State)
        status = self._set_state(self._component, state.handle)
        if status > 1:
            self._require("going back to a saved state", status)
        if state.points is not None and self._slopes is not None:
            self._slopes.points = state.points

    def release(self, state: object) -> None:
        """Give up `state`, unless the instance is dead and must not be called."""
        if self._instance is not None and not self._instance.dead:
            assert isinstance(state, State)
            self._call(self._instance.state_functions.free, byref(state.handle))

    def serialise(self, state: object) -> bytes:
        """Return `state` as bytes."""
        assert isinstance(state, State)
        return serialise(state, self._alive.state_functions, self._call)

    def deserialise(self, data: bytes) -> object:
        """Return a new handle of the state in `data`."""
        shape = None if self._slopes is None else self._slopes.points.shape
        return deserialise(data, self._alive.state_functions, self._call, shape=shape)

    def terminate(self) -> None:
        """End the simulation in order."""
        self._call(f"{self._alive.prefix}Terminate")

    def free(self) -> None:
        """Free instance, library and folder; harmless when repeated."""
        instance, self._instance = self._instance, None
        if instance is not None:
            instance.free()

    @property
    def _alive(self) -> FmuInstance:
        assert self._instance is not None, "instantiate comes first"
        return self._instance

    def _advance_on_slopes(self, time: float, step_size: float) -> Status:
        assert self._slopes is not None
        status = self._slopes.write(step_size)
        if status > 1:
            return self._alive.answer("setting its inputs and their derivatives", status)
        answer = self._alive.step(time, step_size)
        if answer is OK:
            self._slopes.arrive()
        return answer

    def _call(self, function: str, *arguments: object) -> None:
        instance = self._alive
        if instance.dead:
            raise self._error(f"{function} was not called after {instance.prefix}Fatal")
        self._require(function, instance.functions[function](instance.component, *arguments))

    def _require(self, what: str, status: int) -> None:
        if status > 1:
            raise self._error(self._alive.answer(what, status).message)

    def _error(self, failure: str) -> ParticipantError:
        time, step_size = self._when
        inputs = {}
        if time is not None:
            inputs = dict(zip(self._bound[0], self._last_inputs().tolist(), strict=True))
        return ParticipantError(
            participant=self.name,
            failure=failure,
            time=time,
            step_size=step_size,
            inputs=inputs,
            messages=self.messages,
        )
