"""Declaration of FMI variables with everything a model description should say about them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from pythonfmu import Boolean, Fmi2Causality, Fmi2Initial, Fmi2Variability, Integer, Real, String

Value = float | int | bool | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """One scalar variable of an FMU.

    Parameters
    ----------
    name : str
        Structured name, e.g. ``wheel[1].position``.
    causality : {"parameter", "input", "output"}
        Parameters are fixed once initialised.
    description : str
        What it is, with its sign.
    unit : str
        A key of `UNITS`; "" for a Boolean, Integer or String.
    start : float, int, bool or str
        Start value of a parameter or input; its type is the FMI type. For an output it gives the
        type only.
    minimum, maximum, nominal : float or None
        Limits and nominal value of a Real.
    group, index : str, int
        Array of the model and place in it from which an output is taken, or to which an input
        goes.
    initial_dependencies : tuple of str
        Inputs and parameters on which an output depends during initialisation.
    """

    name: str
    causality: Literal["parameter", "input", "output"]
    description: str
    start: Value = 0.0
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    group: str = ""
    index: int = 0
    initial_dependencies: tuple[str, ...] = ()


# SI base exponents of the units in use, for the UnitDefinitions of a model description
UNITS: dict[str, dict[str, int]] = {
    "1": {},
    "1/m": {"m": -1},
    "m": {"m": 1},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "rad": {"rad": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m2": {"kg": 1, "m": 3, "s": -2},
    "N/m": {"kg": 1, "s": -2},
    "N/m1.5": {},
    "N/m2": {"kg": 1, "m": -1, "s": -2},
    "N/m3": {"kg": 1, "m": -2, "s": -2},
    "N/m4": {"kg": 1, "m": -3, "s": -2},
    "N.s/m": {"kg": 1, "s": -1},
    "kg/m": {"kg": 1, "m": -1},
    "kg.m": {"kg": 1, "m": 1},
    "kg.m2": {"kg": 1, "m": 2},
}


def own_parameters(
    owner: object, prefix: str, table: tuple[tuple[str, str, str], ...]
) -> list[Variable]:
    """Parameters with the start values that an object has.

    Parameters
    ----------
    owner : object
        Has an attribute of the name of every parameter.
    prefix : str
        What the parameters' names begin with.
    table : tuple of (str, str, str)
        Name, unit and description of each.
    """
    return [
        Variable(
            name=prefix + name,
            causality="parameter",
            unit=unit,
            start=getattr(owner, name),
            description=description,
        )
        for name, unit, description in table
    ]


def make_scalar(variable: Variable) -> Any:  # noqa: ANN401 - pythonfmu is not typed
    """Scalar variable of pythonfmu, without access functions and value reference."""
    kinds = {bool: Boolean, int: Integer, float: Real, str: String}
    kind = kinds[type(variable.start)]
    options = {"causality": Fmi2Causality[variable.causality], "description": variable.description}
    if variable.causality == "parameter":
        options["variability"] = Fmi2Variability.fixed
        options["initial"] = Fmi2Initial.exact
    else:
        continuous = kind is Real
        options["variability"] = (
            Fmi2Variability.continuous if continuous else Fmi2Variability.discrete
        )
        if variable.causality == "output":
            options["initial"] = Fmi2Initial.calculated
    return kind(variable.name, **options)
