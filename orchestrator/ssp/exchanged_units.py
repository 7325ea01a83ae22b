"""Which unit a value is in, and how it gets into another."""

from collections.abc import Mapping

from ..errors import WiringError
from ..fmu import FmuParticipant
from ..units import Linear, Unit, convert, identity
from .description import Connector


def exchanged_unit(
    participant: FmuParticipant, connector: Connector, units: Mapping[str, Unit]
) -> Unit | str | None:
    """Return the unit in which a variable is exchanged: its definition, else its name.

    A value passes the connector in the connector's unit, whatever that is, so only that of the
    variable counts. The connector's counts where the FMU declares none.
    """
    name = participant.variables[connector.name].unit
    own = None if name is None else participant.units.get(name) or units.get(name) or name
    if connector.unit is None:
        return own
    shown = units.get(connector.unit) or connector.unit
    if own is None:
        return shown
    try:
        convert_between(own, shown)
    except WiringError as error:
        raise WiringError(f"connector {connector.name!r} of {participant.name}: {error}") from error
    return own


def convert_between(source: Unit | str | None, target: Unit | str | None) -> Linear:
    """Return how a value in one unit becomes a value in another.

    A side without a unit takes the value as it is, and so do two that name the same unit.

    Raises
    ------
    WiringError
        When the two measure different things, or one is not defined in SI base units.
    """
    if source is None or target is None:
        return identity
    if isinstance(source, Unit) and isinstance(target, Unit):
        return convert(source, target)
    names = [unit.name if isinstance(unit, Unit) else unit for unit in (source, target)]
    if names[0] == names[1]:
        return identity
    unknown = source if isinstance(source, str) else target
    raise WiringError(
        f"the units {names[0]!r} and {names[1]!r} differ, and {unknown!r} is not defined; define "
        "it in the ssd:Units of the description."
    )
