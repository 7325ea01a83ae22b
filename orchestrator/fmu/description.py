"""What the master needs to know of an FMU, and which start values fit it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from ..errors import FmuError, close_matches
from ..participant import Variable
from ..units import Unit
from .kinds import Kind

StartValue = float | int | bool | str


class Storage(NamedTuple):
    """Where an FMU keeps a value.

    Attributes
    ----------
    reference : int
        Value reference of the variable.
    kind : Kind
        Its type.
    element : int
        Place of the value in the variable, 0 for a scalar.
    size : int
        Number of elements of the variable, 1 for a scalar.
    """

    reference: int
    kind: Kind
    element: int = 0
    size: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuDescription:
    """What the master needs to know of a co-simulation FMU.

    The elements of arrays are variables of their own, ``name[i]`` or ``name[i,j]``, counted from 1.

    Attributes
    ----------
    path : pathlib.Path
        The archive.
    fmi_version : {2, 3}
        For 2.0 and 3.0.
    model_name, model_identifier, guid : str
        As in the model description; the `guid` of FMI 3.0 is its instantiationToken.
    can_save_state, can_serialise_state, can_vary_step, provides_directional_derivatives : bool
        Its claims.
    can_interpolate_inputs : bool
        Whether it takes derivatives of its inputs (FMI 2.0 only).
    dependencies : mapping of str to frozenset of str or None
        For every output the inputs that it depends on without delay; None: not said.
    initial_dependencies : mapping of str to frozenset of str or None
        The same for the initialisation.
    variables : mapping of str to Variable
        Every variable by name.
    storage : mapping of str to Storage
        Where each of them is.
    array_starts : mapping of int to tuple of float
        Start values of all elements of the arrays of numbers, by value reference.
    settable : frozenset of str
        Names that take a start value.
    left_out : mapping of str to str
        Variables that the master cannot use, and why.
    units : mapping of str to Unit
        Units that the model description defines in SI base units, by name.
    """

    path: Path
    fmi_version: Literal[2, 3]
    model_name: str
    model_identifier: str
    guid: str
    can_save_state: bool
    can_serialise_state: bool
    can_vary_step: bool
    can_interpolate_inputs: bool
    provides_directional_derivatives: bool
    dependencies: Mapping[str, frozenset[str] | None]
    initial_dependencies: Mapping[str, frozenset[str] | None]
    variables: Mapping[str, Variable]
    storage: Mapping[str, Storage]
    array_starts: Mapping[int, tuple[float, ...]]
    settable: frozenset[str]
    left_out: Mapping[str, str]
    units: Mapping[str, Unit]

    def check_start_values(self, values: Mapping[str, StartValue]) -> None:
        """Raise `FmuError` unless every value is known, settable and of the right type."""
        for name, value in values.items():
            if name in self.left_out:
                raise FmuError(
                    f"{self.path.name}: {name!r} takes no start value here, because it is "
                    f"{self.left_out[name]}."
                )
            if name not in self.variables:
                raise FmuError(
                    f"{self.path.name}: start value for the unknown variable {name!r}; "
                    f"{close_matches(name, self.variables)}."
                )
            if name not in self.settable:
                raise FmuError(
                    f"{self.path.name}: {name!r} takes no start value, {self._why(name)}."
                )
            _check_type(self.path.name, self.variables[name], value)
            _check_range(self.path.name, name, value, self.storage[name].kind)

    def _why(self, name: str) -> str:
        causality = self.variables[name].causality
        if causality == "structuralParameter":
            return "because the sizes of arrays stay as they are (causality structuralParameter)"
        return f"because the FMU calculates it (causality {causality})"


def _check_type(file: str, variable: Variable, value: StartValue) -> None:
    wanted: tuple[type, ...] = {
        "Real": (float, int),
        "Integer": (int,),
        "Enumeration": (int,),
        "Boolean": (bool,),
        "String": (str,),
    }[variable.type]
    if not isinstance(value, wanted) or (isinstance(value, bool) and bool not in wanted):
        raise FmuError(
            f"{file}: start value {value!r} of {variable.name!r} is of type "
            f"{type(value).__name__}, but the variable is of type {variable.type}."
        )
    if not isinstance(value, str) and not variable.minimum <= value <= variable.maximum:
        raise FmuError(
            f"{file}: start value {value!r} of {variable.name!r} lies outside "
            f"[{variable.minimum:g}, {variable.maximum:g}]."
        )


def _check_range(file: str, name: str, value: StartValue, kind: Kind) -> None:
    """Refuse what C would cut off without a word."""
    limits = kind.range
    if limits is not None and isinstance(value, int) and not limits[0] <= value <= limits[1]:
        raise FmuError(
            f"{file}: start value {value!r} of {name!r} lies outside "
            f"[{limits[0]}, {limits[1]}], which the type {kind.function} can hold."
        )
