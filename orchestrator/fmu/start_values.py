"""Setting start values, of whatever type."""

from collections.abc import Mapping
from ctypes import c_char_p, c_uint
from typing import Any

from .description import StartValue
from .values import Group, Target


def write_start_values(target: Target, values: Mapping[str, StartValue]) -> tuple[str, int]:
    """Set start values of any type, variable by variable.

    Returns
    -------
    name : str
        The first variable that was refused, or ``""``.
    status : int
        The FMI status of that.
    """
    description = target.description
    together: dict[tuple[str, int], list[str]] = {}
    for name in values:
        storage = description.storage[name]
        together.setdefault((storage.kind.function, storage.reference), []).append(name)
    for (function, reference), names in together.items():
        if function == "String":
            text = (c_char_p * 1)(str(values[names[0]]).encode())
            counts = (text,) if description.fmi_version == 2 else (text, 1)
            arguments: tuple[Any, ...] = ((c_uint * 1)(reference), 1, *counts)
        else:
            group = Group(description, names, values)
            group.values[group.places] = [values[name] for name in names]
            arguments = group.arguments
        status = target.bind(f"Set{function}", *arguments)()
        if status > 1:
            return names[0], status
    return "", 0
