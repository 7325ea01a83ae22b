"""An FMI 2.0 slave around a model of this project.

The slave keeps the parameters, the inputs and the phase of its life; everything dynamic is in the
model. A step that the model refuses is discarded: the reason is logged, the state is as before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, ClassVar
from xml.etree.ElementTree import Element

from pythonfmu import Fmi2Slave, Real
from pythonfmu.enums import Fmi2Status

from .communication_point import step_complaint
from .exception_guard import kept_alive
from .grouped_inputs import GroupedInputs
from .library_end import end_in_order
from .model_description import complete
from .model_driver import ModelDriver
from .slave_state import Phase, SlaveState, from_bytes, to_bytes
from .variables import Value, Variable, make_scalar

LINEAR_INPUTS = Variable(
    name="linear_inputs",
    causality="parameter",
    start=False,
    description="Whether an input set before a step is its value at the end of the step, reached "
    "on a straight line from the last one; false: it is held over the step",
)


@kept_alive
class ModelSlave(ModelDriver, Fmi2Slave):  # type: ignore[misc]  # pythonfmu is not typed
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
        self._inputs = GroupedInputs([v for v in self._declared if v.causality == "input"])
        self._outputs: dict[str, Sequence[float]] = {}
        for variable in self._declared:
            self._register(variable)
        # by value reference; the generic way of pythonfmu costs more than a step of the model
        self._real_getters = {
            reference: scalar.getter
            for reference, scalar in self.vars.items()
            if isinstance(scalar, Real)
        }

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
        impossible = step_complaint(self._time, current_time, step_size)
        if impossible is not None:
            self.log(impossible, Fmi2Status.discard)
            return False
        before = self._model.state
        try:
            self.step_model(
                self._model, self._time, step_size, self._inputs.groups, linear=self._linear
            )
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
            inputs=self._inputs.values.copy(),
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
        self._inputs.values[:] = state.inputs
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

    def _register(self, variable: Variable) -> None:
        scalar = make_scalar(variable)
        name = variable.name
        if variable.causality == "parameter":
            scalar.getter = lambda: self._parameters[name]
            scalar.setter = partial(self._set_parameter, name)
        elif variable.causality == "input":
            place = self._inputs.places[name]
            scalar.getter = partial(self._inputs.values.item, place)
            scalar.setter = partial(self._set_input, place)
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
        self._inputs.values[place] = value
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
                self.start_model(self._model, self._time, self._inputs.groups)
            except (ValueError, RuntimeError) as error:
                raise self._logged(error) from error
            self._started = True

    def _logged(self, error: Exception) -> ValueError:
        """Log why the slave cannot be initialised, and the error to raise."""
        self.log(str(error), Fmi2Status.error)
        return ValueError(str(error))
