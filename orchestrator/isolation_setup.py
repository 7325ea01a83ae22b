"""What a process needs to know to open an FMU: said once, before anything else."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Self

from .fmu import StartValue
from .participant import InputShape


@dataclass(frozen=True, slots=True, kw_only=True)
class IsolationSetup:
    """An FMU and the variables exchanged with it.

    Attributes
    ----------
    path : str
        The FMU; absolute, wherever the process runs.
    name : str
        Name in the system.
    start_values : mapping of str to float, int, bool or str
        Values to set before the initialisation.
    inputs, outputs, observed : tuple of str
        Names of the variables exchanged.
    input_shape : InputShape
        How inputs shall run over a step.
    """

    path: str
    name: str
    start_values: Mapping[str, StartValue] = field(default_factory=dict)
    inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    observed: tuple[str, ...] = ()
    input_shape: InputShape = "held"

    def bound(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> Self:
        """Return the same FMU with these variables."""
        return replace(
            self,
            inputs=tuple(inputs),
            outputs=tuple(outputs),
            observed=tuple(observed),
            input_shape=input_shape,
        )

    def write(self) -> bytes:
        """Return it as bytes."""
        return json.dumps(asdict(self)).encode()

    @classmethod
    def read(cls, data: bytes) -> Self:
        """Return what `write` wrote."""
        words = json.loads(data)
        return cls(**words | {key: tuple(words[key]) for key in ("inputs", "outputs", "observed")})
