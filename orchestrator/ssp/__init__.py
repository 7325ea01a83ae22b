"""System Structure and Parameterization: systems of FMUs from .ssd and .ssp files, and to them."""

from .assembly import AssembledSystem, assemble
from .description import (
    Component,
    Connector,
    Link,
    MappingEntry,
    MasterChoices,
    ParameterBinding,
    ParameterValue,
    SystemDescription,
)
from .master_annotation import annotation_type
from .package import open_system
from .writing import write_description

__all__ = [
    "AssembledSystem",
    "Component",
    "Connector",
    "Link",
    "MappingEntry",
    "MasterChoices",
    "ParameterBinding",
    "ParameterValue",
    "SystemDescription",
    "annotation_type",
    "assemble",
    "open_system",
    "write_description",
]
