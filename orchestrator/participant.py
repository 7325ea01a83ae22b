"""What a participant of a co-simulation must be able to do: an FMU, a fake, a remote process."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from math import inf, isnan
from typing import Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .errors import WiringError

type_names = ("Real", "Integer", "Boolean", "String", "Enumeration")

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]
InputShape = Literal["held", "linear"]
"""How an input runs over a step: ``held`` at the value set, or ``linear`` from the last to it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A variable of a participant.

    Attributes
    ----------
    name : str
        Name within the participant, for example ``wheel[1].contact_force``.
    type : {'Real', 'Integer', 'Boolean', 'String', 'Enumeration'}
        Type of the value.
    causality : str
        ``input``, ``output``, ``parameter``, ``local``, ... as FMI names them.
    variability : str
        ``continuous``, ``discrete``, ``fixed``, ... as FMI names them.
    unit : str or None
        Unit as declared.
    nominal : float or None
        Order of magnitude, positive, in `unit`; None when not declared.
    minimum, maximum : float
        Bounds in `unit`, infinite when not declared.
    description : str
        What it is, its sign.
    """

    name: str
    type: str = "Real"
    causality: str = "local"
    variability: str = "continuous"
    unit: str | None = None
    nominal: float | None = None
    minimum: float = -inf
    maximum: float = inf
    description: str = ""

    def __post_init__(self) -> None:
        if self.type not in type_names:
            raise WiringError(
                f"{self.name}: type {self.type!r} is none of {', '.join(type_names)}."
            )
        if self.nominal is not None and not 0.0 < self.nominal < inf:
            raise WiringError(f"{self.name}: nominal {self.nominal} must be positive and finite.")
        if isnan(self.minimum) or isnan(self.maximum) or self.minimum > self.maximum:
            raise WiringError(
                f"{self.name}: minimum {self.minimum} must not exceed maximum {self.maximum}."
            )


class StatusKind(Enum):
    """How a call to a participant ended."""

    OK = "ok"
    DISCARD = "discard"
    """Nothing is wrong, but not with this step: a smaller one may do."""
    EARLY = "early"
    """The step ended before its end, and will do when it is repeated up to there."""
    ERROR = "error"
    """The result is unusable; going back to a saved state may help."""
    FATAL = "fatal"
    """The participant is dead and is never called again."""


class Status(NamedTuple):
    """End of a call as a value.

    Attributes
    ----------
    kind : StatusKind
        How it ended.
    message : str
        Which call it was and what it answered.
    last_successful_time : float or None
        Up to where a discarded step was computed [s], if that is known and beyond the start; where
        an early one ended.
    """

    kind: StatusKind
    message: str = ""
    last_successful_time: float | None = None


OK = Status(StatusKind.OK)
"""The one status of success: compare with ``is``."""


class Participant(Protocol):
    """One partner of the co-simulation.

    The calls come in this order: `bind`, `instantiate`, `enter_initialisation`, then any number of
    `set_inputs` and `get_outputs`, `exit_initialisation`, then steps, `terminate`, `free`. Only
    `free` may come at any time, and again.

    Calls that may fail in the normal course of a run answer with a `Status`; the others raise
    `ParticipantError`.
    """

    @property
    def name(self) -> str:
        """Name in the system, without a dot."""

    @property
    def variables(self) -> Mapping[str, Variable]:
        """Every variable by name."""

    @property
    def can_save_state(self) -> bool:
        """Whether it claims that `save` and `restore` work."""

    @property
    def can_serialise_state(self) -> bool:
        """Whether it claims that `serialise` and `deserialise` work."""

    @property
    def can_vary_step(self) -> bool:
        """Whether steps may differ in size."""

    @property
    def dependencies(self) -> Mapping[str, frozenset[str] | None]:
        """For every output the inputs that it depends on without delay; None: not known."""

    @property
    def initial_dependencies(self) -> Mapping[str, frozenset[str] | None]:
        """For every output the inputs it depends on during the initialisation; None: not known."""

    @property
    def provides_directional_derivatives(self) -> bool:
        """Whether it claims that `directional_derivatives` works."""

    @property
    def input_shape(self) -> InputShape:
        """How its inputs run over a step; valid after `bind`."""

    @property
    def messages(self) -> Sequence[str]:
        """What it logged last, oldest first."""

    def bind(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        """Fix which variables `set_inputs`, `get_outputs` and `get_observed` mean, in this order.

        `input_shape` is what the master would like; the participant does what it can.
        """

    def instantiate(self) -> None:
        """Create the instance and give it its start values."""

    def enter_initialisation(
        self, *, start_time: float, stop_time: float, tolerance: float | None
    ) -> None:
        """Begin the initialisation at `start_time` [s]."""

    def exit_initialisation(self) -> None:
        """End the initialisation: steps follow."""

    def set_inputs(self, values: Vector) -> Status:
        """Set the bound inputs, shape (n_inputs,)."""

    def get_outputs(self, out: Vector) -> Status:
        """Write the bound outputs to `out`, shape (n_outputs,)."""

    def get_observed(self, out: Vector) -> Status:
        """Write the observed values to `out`, shape (n_observed,); Booleans as 0 and 1."""

    def directional_derivatives(self, out: Matrix) -> Status:
        """Write what each bound output gains with each bound input, at the present point.

        `out` has the shape (n_outputs, n_inputs) and the units of the participant.
        """

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""

    def save(self) -> object:
        """Return a new handle of the complete present state; `release` ends its life."""

    def restore(self, state: object) -> None:
        """Go back to `state`, which stays valid."""

    def release(self, state: object) -> None:
        """Give up `state`."""

    def serialise(self, state: object) -> bytes:
        """Return `state` as bytes that another process can read."""

    def deserialise(self, data: bytes) -> object:
        """Return a new handle of the state in `data`."""

    def terminate(self) -> None:
        """End the simulation in order."""

    def free(self) -> None:
        """Give up the instance and everything it holds; harmless when repeated."""
