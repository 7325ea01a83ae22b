"""What a system description says, without the XML."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..fmu import StartValue
from ..units import Linear, Unit, identity

SettingValue = float | int | bool | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Connector:
    """A variable of a component that may be connected.

    Attributes
    ----------
    name : str
        Name of the variable in the FMU.
    kind : str
        ``input``, ``output``, ``parameter``, ... as SSP names them.
    type : str or None
        ``Real``, ``Integer``, ``Boolean``, ``String`` or ``Enumeration``; None where it is left to
        the FMU.
    unit : str or None
        Unit of the values that pass through it; None where it is left to the FMU.
    """

    name: str
    kind: str
    type: str | None = None
    unit: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterValue:
    """A value for a variable.

    Attributes
    ----------
    name : str
        Name of the parameter in its source.
    value : float, int, bool or str
        The value.
    unit : str or None
        Unit of a Real value; None for that of the variable it goes to.
    """

    name: str
    value: StartValue
    unit: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class MappingEntry:
    """Which variable takes which parameter.

    Attributes
    ----------
    source, target : str
        Names of the parameter and of the variable.
    transformation : Linear
        Applied to a Real value after the conversion of its unit.
    converts_units : bool
        Whether its unit is converted at all.
    """

    source: str
    target: str
    transformation: Linear = identity
    converts_units: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterBinding:
    """Values for a component or the system.

    Attributes
    ----------
    values : tuple of ParameterValue
        The values.
    prefix : str
        Put before every name first.
    mapping : tuple of MappingEntry or None
        Which values go where; None for all of them to variables of their own names.
    units : mapping of str to Unit
        Units that the source of the values defines.
    """

    values: tuple[ParameterValue, ...]
    prefix: str = ""
    mapping: tuple[MappingEntry, ...] | None = None
    units: Mapping[str, Unit] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """An FMU in the system.

    Attributes
    ----------
    name : str
        Name in the system, without a dot.
    source : str
        Path of the FMU relative to the description, with forward slashes.
    connectors : tuple of Connector
        At least those that are connected.
    bindings : tuple of ParameterBinding
        Values for its variables; of two for the same one the later counts.
    """

    name: str
    source: str
    connectors: tuple[Connector, ...] = ()
    bindings: tuple[ParameterBinding, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """A connection; which end drives the other follows from the kinds of the connectors.

    Attributes
    ----------
    start, end : tuple of str
        Names of component and connector.
    transformation : Linear
        Applied after the conversion of units.
    converts_units : bool
        Whether units are converted at all.
    """

    start: tuple[str, str]
    end: tuple[str, str]
    transformation: Linear = identity
    converts_units: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class MasterChoices:
    """What a description says about the master.

    Attributes
    ----------
    settings : mapping
        Some of the attributes of `orchestrator.MasterSettings` by name.
    events : tuple of str
        Event indicators as ``component.variable``.
    bonds : tuple of (str, str)
        Forces and the motions they act along, as ``component.variable``.
    """

    settings: Mapping[str, SettingValue] = field(default_factory=dict)
    events: tuple[str, ...] = ()
    bonds: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SystemDescription:
    """A system of FMUs.

    Attributes
    ----------
    name : str
        What it is called.
    components : tuple of Component
        The FMUs; their order decides wherever nothing else does.
    links : tuple of Link
        The connections.
    bindings : tuple of ParameterBinding
        Values for variables ``component.variable``, which count more than those of components.
    units : mapping of str to Unit
        Units that the description defines.
    start_time, stop_time : float or None
        Default experiment [s].
    master : MasterChoices
        What it says about the master.
    """

    name: str
    components: tuple[Component, ...]
    links: tuple[Link, ...] = ()
    bindings: tuple[ParameterBinding, ...] = ()
    units: Mapping[str, Unit] = field(default_factory=dict)
    start_time: float | None = None
    stop_time: float | None = None
    master: MasterChoices = field(default_factory=MasterChoices)
