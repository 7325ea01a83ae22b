"""From parameter bindings to start values."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..errors import WiringError
from ..fmu import FmuParticipant, StartValue
from ..units import Linear, Unit, identity
from .description import ParameterBinding
from .exchanged_units import convert_between


class Assignment(NamedTuple):
    """A value on its way to the variable of some name.

    Attributes
    ----------
    name : str
        Name of the variable, of ``component.variable`` for bindings of the system.
    value : float, int, bool or str
        The value.
    unit : Unit, str or None
        Its unit, by definition or by name; None for that of the variable.
    transformation : Linear
        Applied after the conversion of the unit.
    converts_units : bool
        Whether the unit is converted.
    """

    name: str
    value: StartValue
    unit: Unit | str | None
    transformation: Linear = identity
    converts_units: bool = True


def assignments(bindings: Sequence[ParameterBinding]) -> list[Assignment]:
    """Return what bindings give to which names, in the order in which they count."""
    found = []
    for binding in bindings:
        given = [
            Assignment(
                binding.prefix + item.name,
                item.value,
                None if item.unit is None else binding.units.get(item.unit, item.unit),
            )
            for item in binding.values
        ]
        if binding.mapping is not None:
            by_name = {item.name: item for item in given}
            given = [
                by_name[entry.source]._replace(
                    name=entry.target,
                    transformation=entry.transformation,
                    converts_units=entry.converts_units,
                )
                for entry in binding.mapping
                if entry.source in by_name
            ]
        found += given
    return found


def start_value(
    item: Assignment, participant: FmuParticipant, units: Mapping[str, Unit]
) -> StartValue:
    """Return a value in the unit of its variable.

    Parameters
    ----------
    item : Assignment
        The value.
    participant : FmuParticipant
        The FMU that has the variable.
    units : mapping of str to Unit
        Units that the description defines.

    Raises
    ------
    WiringError
        For a unit that does not fit, or a transformation of something that is no Real.
    """
    variable = participant.variables[item.name]
    where = f"the value of {participant.name}.{item.name}"
    if variable.type != "Real" or isinstance(item.value, (bool, str)):
        if item.transformation != identity:
            raise WiringError(f"{where}: only Real values can be transformed.")
        return item.value
    conversion = identity
    if item.converts_units and item.unit is not None:
        unit = units.get(item.unit, item.unit) if isinstance(item.unit, str) else item.unit
        own = variable.unit
        target = None if own is None else participant.units.get(own) or units.get(own) or own
        try:
            conversion = convert_between(unit, target)
        except WiringError as error:
            raise WiringError(f"{where}: {error}") from error
    change = item.transformation.after(conversion)
    return item.value if change == identity else change(item.value)
