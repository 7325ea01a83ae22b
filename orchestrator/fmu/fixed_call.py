"""Calls of C functions without the cost of checking their arguments every time."""

from collections.abc import Callable
from ctypes import CFUNCTYPE, c_int, c_void_p, cast
from functools import partial
from typing import Any

_Untyped = CFUNCTYPE(c_int)


def untyped(function: Any) -> Callable[..., int]:  # noqa: ANN401 - ctypes names no type for it
    """Return a C function that returns an int, without its declared argument types.

    ctypes checks and converts each argument of a typed function at every call, which takes longer
    than a small FMU does. The arguments of the function returned must be ctypes objects of exactly
    the right types, with arrays or `byref` where a pointer is expected: nothing checks them.
    """
    address = cast(function, c_void_p).value
    assert address is not None, "a function has an address"
    return _Untyped(address)


def fixed_call(function: Any, *arguments: object) -> Callable[[], int]:  # noqa: ANN401 - as above
    """Return a call of `function` with these ctypes objects, see `untyped`.

    What they hold may change from call to call.
    """
    assert not any(isinstance(item, (int, float)) for item in arguments), "numbers carry no C type"
    return partial(untyped(function), *arguments)
