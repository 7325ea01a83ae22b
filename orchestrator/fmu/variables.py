"""From the variables of a model description to those of the master: arrays taken apart."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from math import inf, prod
from typing import Any

from ..errors import FmuError, WiringError
from ..participant import Variable
from .description import Storage
from .kinds import Kind, fmi2_kinds, fmi3_kinds

largest_array = 10_000
"""Arrays of more elements are left out."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundVariables:
    """What a model description says of its variables; the fields are those of `FmuDescription`."""

    variables: dict[str, Variable] = field(default_factory=dict)
    storage: dict[str, Storage] = field(default_factory=dict)
    array_starts: dict[int, tuple[float, ...]] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    settable: set[str] = field(default_factory=set)


def read_variables(file: str, model: Any) -> FoundVariables:  # noqa: ANN401 - fmpy carries no types
    """Return the variables of `model`, which fmpy read from `file`.

    Raises
    ------
    FmuError
        When an element of an array has the name of another variable, or bounds or nominal value of
        a variable are none.
    """
    kinds = fmi2_kinds if model.fmiVersion == "2.0" else fmi3_kinds
    found = FoundVariables()
    for item in model.modelVariables:
        reason = _why_left_out(item, kinds)
        if reason is not None:
            found.left_out[item.name] = reason
            continue
        kind, size = kinds[item.type], prod(item.shape)
        reference = int(item.valueReference)
        if item.shape and kind.type != "String":
            found.array_starts[reference] = _array_start(file, item, kind)
        for element, name in enumerate(element_names(item)):
            if name in found.variables:
                raise FmuError(f"{file}: two variables are called {name!r}.")
            try:
                found.variables[name] = _variable(item, name, kind.type)
            except WiringError as error:
                raise FmuError(f"{file}: {error}") from error
            found.storage[name] = Storage(reference, kind, element, size)
            if _takes_start(item):
                found.settable.add(name)
    return found


def element_names(item: Any) -> Iterator[str]:  # noqa: ANN401 - fmpy carries no types
    """Yield the name of a scalar, or those of the elements of an array, the last index fastest."""
    if not item.shape:
        yield item.name
        return
    for indices in product(*(range(1, size + 1) for size in item.shape)):
        yield f"{item.name}[{','.join(map(str, indices))}]"


def dependencies(
    model: Any,  # noqa: ANN401 - fmpy carries no types
    unknowns: Any,  # noqa: ANN401 - fmpy carries no types
    found: FoundVariables,
) -> Mapping[str, frozenset[str] | None]:
    """Return what each output depends on; one that is not among the `unknowns` may on all.

    These are the Outputs or the InitialUnknowns of the ModelStructure. An alias depends on what its
    variable depends on, and who depends on a variable does so on its aliases.
    """
    inputs: dict[str, list[str]] = {}
    for item in model.modelVariables:
        if item.causality == "input" and item.name not in found.left_out:
            inputs.setdefault(_base(item).name, []).extend(element_names(item))
    said = {
        item.variable.name: frozenset(
            name for other in item.dependencies for name in inputs.get(other.name, ())
        )
        for item in unknowns
        if item.dependencies is not None
    }
    return {
        name: said.get(_base(item).name)
        for item in model.modelVariables
        if item.causality == "output" and item.name not in found.left_out
        for name in element_names(item)
    }


def _base(item: Any) -> Any:  # noqa: ANN401 - fmpy carries no types
    return item if item.alias is None else item.alias


def _why_left_out(item: Any, kinds: Mapping[str, Kind]) -> str | None:  # noqa: ANN401 - no types
    if item.type not in kinds:
        return f"of type {item.type}, which is not supported"
    if item.shape and item.type == "String":
        return "an array of strings, which are not supported"
    if prod(item.shape) > largest_array:
        return f"an array of {prod(item.shape)} elements, of which at most {largest_array} are read"
    return None


def _array_start(file: str, item: Any, kind: Kind) -> tuple[float, ...]:  # noqa: ANN401 - no types
    """Return the start values of all elements: one of each, one for all of them, or zero."""
    texts, size = (item.start or "0").split(), prod(item.shape)
    if len(texts) not in {1, size}:
        raise FmuError(f"{file}: {item.name!r} has {size} elements, but {len(texts)} start values.")
    if kind.type == "Boolean":
        texts = [{"true": "1", "false": "0"}.get(text, text) for text in texts]
    convert = float if kind.type == "Real" else int
    return tuple(convert(text) for text in (texts if len(texts) == size else texts * size))


def _takes_start(item: Any) -> bool:  # noqa: ANN401 - fmpy carries no types
    if item.variability == "constant" or item.causality in {"independent", "structuralParameter"}:
        return False
    return item.causality == "input" or item.initial in {"exact", "approx"}


def _variable(item: Any, name: str, type_name: str) -> Variable:  # noqa: ANN401 - no types
    def attribute(key: str) -> Any:  # noqa: ANN401 - fmpy carries no types
        value = getattr(item, key)
        if value is None and item.declaredType is not None:
            value = getattr(item.declaredType, key)
        return value

    nominal, low, high = attribute("nominal"), attribute("min"), attribute("max")
    return Variable(
        name=name,
        type=type_name,
        causality=item.causality,
        variability=item.variability,
        unit=attribute("unit"),
        nominal=None if nominal is None else abs(float(nominal)),
        minimum=-inf if low is None else float(low),
        maximum=inf if high is None else float(high),
        description=item.description or "",
    )
