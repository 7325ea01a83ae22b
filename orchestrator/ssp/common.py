"""Elements that all SSP files share: units and transformations."""

from collections.abc import Mapping

from ..errors import WiringError
from ..units import Linear, Unit, base_units, identity
from .documents import Element

type_names: Mapping[str, str] = {
    "Real": "Real",
    "Float64": "Real",
    "Float32": "Real",
    "Integer": "Integer",
    **{f"{sign}Int{bits}": "Integer" for sign in ("", "U") for bits in (8, 16, 32, 64)},
    "Boolean": "Boolean",
    "String": "String",
    "Enumeration": "Enumeration",
}
"""Types of SSP 1.0 and 2.0, and the type of FMI 2.0 that each is."""

other_transformations = (
    "ssc:BooleanMappingTransformation",
    "ssc:IntegerMappingTransformation",
    "ssc:EnumerationMappingTransformation",
)

for_tools = ("ssc:MetaData", "ssc:Signature")
"""Elements of SSP 2.0 without a meaning for a simulation."""


def read_units(units: Element | None) -> dict[str, Unit]:
    """Read the element that defines units, if there is one."""
    found: dict[str, Unit] = {}
    if units is None:
        return found
    units.allow(children=["ssc:Unit"])
    for element in units.children():
        element.allow(attributes=["name"], children=["ssc:BaseUnit", "ssc:Annotations"])
        base = element.child("ssc:BaseUnit")
        if base is None:
            raise element.error("ssc:BaseUnit is missing")
        base.allow(attributes=[*base_units, "factor", "offset"])
        name = element.need("name")
        if name in found:
            raise element.error(f"the unit {name!r} is defined twice")
        try:
            found[name] = Unit(
                name=name,
                exponents=tuple(base.integer(symbol, 0) for symbol in base_units),
                factor=base.number("factor", 1.0),
                offset=base.number("offset", 0.0),
            )
        except WiringError as error:
            raise base.error(str(error).rstrip(".")) from error
    return found


def read_transformation(element: Element) -> Linear:
    """Read the transformation in a connection or mapping entry; the identity where there is none.

    Raises
    ------
    SystemFileError
        For a transformation by a table, which is not supported.
    """
    for tag in other_transformations:
        other = element.child(tag)
        if other is not None:
            raise other.error("only linear transformations are supported")
    linear = element.child("ssc:LinearTransformation")
    if linear is None:
        return identity
    linear.allow(attributes=["factor", "offset"])
    found = Linear(linear.number("factor", 1.0), linear.number("offset", 0.0))
    if not found.is_sound:
        raise linear.error("factor is 0, which loses the value; give another one")
    return found
