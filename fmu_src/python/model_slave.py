"""An FMI 2.0 slave around a model of this project.

The slave keeps the parameters, the inputs and the phase of its life; everything dynamic is in the
model. A step that the model refuses is discarded: the reason is logged, the state is as before.
"""

from __future__ import annotations

import ctypes
import math
from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from functools import partial, wraps
from typing import Any, ClassVar, Protocol
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray
from pythonfmu import Fmi2Slave, Real
from pythonfmu.enums import Fmi2Status

from .library_end import end_in_order
from .model_description import complete
from .slave_state import SlaveState, from_bytes, to_bytes
from .variables import Value, Variable, make_scalar

FloatArray = NDArray[np.float64]
TIME_TOLERANCE = 1e-9  # relative; a master's and a slave's sums of steps may differ by rounding

LINEAR_INPUTS = Variable(
    name="linear_inputs",
    causality="parameter",
    start=False,
    description="Whether an input set before a step is its value at the end of the step, reached "
    "on a straight line from the last one; false: it is held over the step",
)


class Phase(IntEnum):
    """Where a slave is in its life."""

    INSTANTIATED = 0
    INITIALISING = 1
    STEPPING = 2


class Model(Protocol):
    """What a slave needs of a model beyond its own methods."""

    @property
    def state(self) -> FloatArray:
        """Copy of the complete state."""
        ...

    @state.setter
    def state(self, saved: FloatArray) -> None: ...


class ModelSlave(Fmi2Slave):  # type: ignore[misc]  # pythonfmu is not typed
    """Base class of the slaves; a subclass declares the variables and drives its model.

    Class attributes are set by the slave file that a build writes.
    """

    build: ClassVar[str] = "source"
    author = "The railcosim authors"
    license = "BSD-3-Clause"

    def __init__(self, **kwargs: Any) -> None:  # noqa: ANN401 - pythonfmu's own signature
        super().__init__(**kwargs)
        end_in_order(self.resources)
        self._declared = list(self.declare())
        self._linear = False
        self._phase = Phase.INSTANTIATED
        self._time = 0.0
        self._model: Any = None
        self._made_from: tuple[Value, ...] | None = None
        self._started = False
        self._parameters = {v.name: v.start for v in self._declared if v.causality == "parameter"}
        self._values_known: tuple[Value, ...] | None = None
        inputs = [v for v in self._declared if v.causality == "input"]
        self._inputs: FloatArray = np.array([v.start for v in inputs], dtype=float)
        self._outputs: dict[str, Sequence[float]] = {}
        self._groups: dict[str, FloatArray] = {}
        for i, variable in enumerate(inputs):
            if variable.index == 0:
                size = sum(other.group == variable.group for other in inputs)
                self._groups[variable.group] = self._inputs[i : i + size]
        place = {v.name: i for i, v in enumerate(inputs)}
        for variable in self._declared:
            self._register(variable, place)
        # by value reference; the generic way of pythonfmu costs more than a step of the model
        self._real_getters = {
            reference: scalar.getter
            for reference, scalar in self.vars.items()
            if isinstance(scalar, Real)
        }

    @abstractmethod
    def declare(self) -> Sequence[Variable]:
        """All variables of the FMU; the inputs of a group stand together, in ascending index."""

    @abstractmethod
    def make_model(self, parameters: Mapping[str, Any]) -> Model:
        """Make the model; a ValueError says what is wrong with the parameters."""

    @abstractmethod
    def start_model(self, model: Any, time: float, inputs: Mapping[str, FloatArray]) -> None:  # noqa: ANN401 - the subclass's own model
        """Put the model in its initial state for the given inputs."""

    @abstractmethod
    def step_model(
        self,
        model: Any,  # noqa: ANN401 - the subclass's own model
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """Advance the model; a ValueError or RuntimeError says why the step is impossible."""

    @abstractmethod
    def read_model(self, model: Any, group: str) -> Sequence[float]:  # noqa: ANN401 - as above
        """Outputs of a group, in the order of their index."""

    # what pythonfmu calls

    def setup_experiment(
        self, start_time: float, stop_time: float | None, tolerance: float | None
    ) -> None:
        """Keep the start time; stop time and tolerance do not matter to these models."""
        del stop_time, tolerance
        self._time = start_time

    def enter_initialization_mode(self) -> None:
        """Make the model, so that parameters that no model can have are refused here."""
        if self._phase != Phase.INSTANTIATED:
            raise self._logged(ValueError("the initialisation has begun already; reset first"))
        if not math.isfinite(self._time):
            raise self._logged(ValueError(f"the start time is {self._time!r} s, not a number"))
        self._make_model()
        self._phase = Phase.INITIALISING

    def exit_initialization_mode(self) -> None:
        """Fix the initial state."""
        if self._phase != Phase.INITIALISING:
            raise self._logged(ValueError("the initialisation ends after it has begun"))
        self._ensure_started()
        self._phase = Phase.STEPPING

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance by one step; False (a discarded step) with a logged reason if impossible."""
        if self._phase != Phase.STEPPING:
            self.log("a step comes after the initialisation", Fmi2Status.discard)
            return False
        if not math.isclose(current_time, self._time, rel_tol=TIME_TOLERANCE, abs_tol=1e-12):
            self.log(
                f"a step from {current_time!r} s does not continue from "
                f"{self._time!r} s; restore the state of that time first",
                Fmi2Status.discard,
            )
            return False
        if step_size > 0.0 and current_time + step_size == current_time:
            self.log(
                f"a step of {step_size:g} s from {current_time!r} s does not move the time on; use "
                "a longer one",
                Fmi2Status.discard,
            )
            return False
        before = self._model.state
        try:
            self.step_model(self._model, self._time, step_size, self._groups, linear=self._linear)
        except (ValueError, RuntimeError, ArithmeticError) as error:
            self._model.state = before
            self.log(str(error), Fmi2Status.discard)
            return False
        self._time = current_time + step_size
        self._outputs.clear()
        return True

    def get_real(self, vrs: Sequence[int]) -> list[float]:
        """Values of Real variables."""
        getters = self._real_getters
        try:
            return [getters[reference]() for reference in vrs]
        except KeyError as error:
            raise self._logged(TypeError(f"no Real has value reference {error}")) from None

    def to_xml(self, model_options: Mapping[str, str] | None = None) -> Element:
        """Complete model description."""
        root = super().to_xml(dict(model_options or {}))
        return complete(root, self._declared, guid=self.build)

    def _get_fmu_state(self) -> SlaveState:
        return SlaveState(
            identity=self._identity,
            phase=self._phase,
            time=self._time,
            parameters=self._values(),
            inputs=self._inputs.copy(),
            model=self._model.state if self._started else None,
        )

    def _set_fmu_state(self, state: SlaveState) -> None:
        if state.identity != self._identity:
            message = f"the state was saved by {state.identity}, this is {self._identity}"
            raise self._logged(ValueError(f"{message}; use states of the same build only"))
        self._parameters = dict(zip(self._parameters, state.parameters, strict=True))
        self._values_known = state.parameters
        if state.phase != Phase.INSTANTIATED and self._made_from != state.parameters:
            self._make_model()
        self._phase, self._time = Phase(state.phase), state.time
        self._inputs[:] = state.inputs
        self._started = state.model is not None
        if state.model is not None:
            self._model.state = state.model
        self._outputs.clear()

    @staticmethod
    def _fmu_state_to_bytes(state: SlaveState) -> bytes:
        return to_bytes(state)

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> SlaveState:
        return from_bytes(state)

    # the slave's own

    @property
    def _identity(self) -> str:
        return f"{self.modelName} {self.build}"

    def _register(self, variable: Variable, place: Mapping[str, int]) -> None:
        scalar = make_scalar(variable)
        name = variable.name
        if variable.causality == "parameter":
            scalar.getter = lambda: self._parameters[name]
            scalar.setter = partial(self._set_parameter, name)
        elif variable.causality == "input":
            scalar.getter = partial(self._inputs.item, place[name])
            scalar.setter = partial(self._set_input, place[name])
        else:
            scalar.getter = self._reader(variable.group, variable.index)
        self.register_variable(scalar, nested=False)

    def _reader(self, group: str, index: int) -> Callable[[], float]:
        def read() -> float:
            values = self._outputs.get(group)
            return (self._read(group) if values is None else values)[index]

        return read

    def _read(self, group: str) -> Sequence[float]:
        """Outputs of a group, worked out once per state; before initialisation nothing is known."""
        if self._phase == Phase.INSTANTIATED:
            return [0.0] * (1 + max(v.index for v in self._declared if v.group == group))
        self._ensure_started()
        values = self._outputs[group] = self.read_model(self._model, group)
        return values

    def _set_parameter(self, name: str, value: Value) -> None:
        if self._phase == Phase.STEPPING:
            message = f"{name} is fixed once the initialisation has ended; set it before"
            raise self._logged(ValueError(message))
        self._parameters[name] = value
        self._values_known = None
        self._note_change()

    def _values(self) -> tuple[Value, ...]:
        """Values of all parameters; one tuple for all states until a parameter changes.

        CPython 3.11 keeps up to 2000 freed tuples of 20 items without using them again.
        """
        if self._values_known is None:
            self._values_known = tuple(self._parameters.values())
        return self._values_known

    def _set_input(self, place: int, value: float) -> None:
        self._inputs[place] = value
        self._note_change()

    def _note_change(self) -> None:
        """Forget what was worked out from values that still set the initial state."""
        if self._phase == Phase.INITIALISING:
            self._started = False
            self._outputs.clear()

    def _make_model(self) -> None:
        self._linear = bool(self._parameters[LINEAR_INPUTS.name])
        try:
            self._model = self.make_model(self._parameters)
            self._made_from = self._values()
        except (ValueError, RuntimeError) as error:
            raise self._logged(error) from error

    def _ensure_started(self) -> None:
        if not self._started:
            if self._made_from != self._values():
                self._make_model()
            try:
                self.start_model(self._model, self._time, self._groups)
            except (ValueError, RuntimeError) as error:
                raise self._logged(error) from error
            self._started = True

    def _logged(self, error: Exception) -> ValueError:
        """Log why the slave cannot be initialised, and the error to raise."""
        self.log(str(error), Fmi2Status.error)
        return ValueError(str(error))


def _keep_alive(method: Callable[..., Any]) -> Callable[..., Any]:
    """Keep the slave alive when a method raises.

    For every exception pythonfmu 0.7 gives back the references to class, instance and log, and
    once more when the instance is freed; without another set of references that is a crash.
    """

    @wraps(method)
    def guarded(self: ModelSlave, *arguments: Any) -> Any:  # noqa: ANN401 - whatever it takes
        try:
            return method(self, *arguments)
        except Exception:
            for owned in (type(self), self, self.log_queue):
                ctypes.pythonapi.Py_IncRef(ctypes.py_object(owned))
            raise

    return guarded


for _name in (
    "setup_experiment",
    "enter_initialization_mode",
    "exit_initialization_mode",
    "do_step",
    "terminate",
    *(f"{access}_{kind}" for access in ("get", "set") for kind in
      ("real", "integer", "boolean", "string")),
    "_get_fmu_state",
    "_set_fmu_state",
):  # fmt: skip
    setattr(ModelSlave, _name, _keep_alive(getattr(ModelSlave, _name)))
