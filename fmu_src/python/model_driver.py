"""What a slave asks of the model that it drives, and of the subclass that knows the model."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .variables import Variable

FloatArray = NDArray[np.float64]


class Model(Protocol):
    """What a slave needs of a model beyond its own methods."""

    @property
    def state(self) -> FloatArray:
        """Copy of the complete state."""
        ...

    @state.setter
    def state(self, saved: FloatArray) -> None: ...


class ModelDriver(ABC):
    """The part of a slave that differs from model to model: its variables and how it is driven."""

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
