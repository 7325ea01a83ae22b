"""The types of variables of FMI 2.0 and 3.0, and the types of the master that they become."""

import ctypes
from collections.abc import Mapping
from typing import Any, NamedTuple


class Kind(NamedTuple):
    """How values of a type are exchanged with an FMU.

    Attributes
    ----------
    function : str
        What the names of its functions end with, for example ``Float64``.
    c_type : type
        Type of its values in C.
    type : str
        Type of the master's variables.
    """

    function: str
    c_type: Any
    type: str

    @property
    def range(self) -> tuple[int, int] | None:
        """Smallest and largest value of a type of integers."""
        if self.type not in {"Integer", "Enumeration"}:
            return None
        bits = 8 * ctypes.sizeof(self.c_type)
        if self.c_type(-1).value > 0:
            return 0, 2**bits - 1
        return -(2 ** (bits - 1)), 2 ** (bits - 1) - 1


fmi2_kinds: Mapping[str, Kind] = {
    "Real": Kind("Real", ctypes.c_double, "Real"),
    "Integer": Kind("Integer", ctypes.c_int, "Integer"),
    "Enumeration": Kind("Integer", ctypes.c_int, "Enumeration"),
    "Boolean": Kind("Boolean", ctypes.c_int, "Boolean"),
    "String": Kind("String", ctypes.c_char_p, "String"),
}
fmi3_kinds: Mapping[str, Kind] = {
    "Float64": Kind("Float64", ctypes.c_double, "Real"),
    "Float32": Kind("Float32", ctypes.c_float, "Real"),
    **{
        f"{sign}Int{bits}": Kind(
            f"{sign}Int{bits}", getattr(ctypes, f"c_{sign.lower()}int{bits}"), "Integer"
        )
        for sign in ("", "U")
        for bits in (8, 16, 32, 64)
    },
    "Enumeration": Kind("Int64", ctypes.c_int64, "Enumeration"),
    "Boolean": Kind("Boolean", ctypes.c_bool, "Boolean"),
    "String": Kind("String", ctypes.c_char_p, "String"),
}
"""Binary and Clock are missing: no value of theirs can be coupled, set or recorded."""
