"""Saved states of an FMU, and their way to bytes and back."""

from collections.abc import Callable
from ctypes import byref, c_size_t, c_void_p
from typing import Any, NamedTuple

import numpy as np

from ..participant import Vector


class StateFunctions(NamedTuple):
    """How a version of FMI calls the functions for states, and its C type of a byte."""

    get: str
    set: str
    free: str
    size: str
    serialise: str
    deserialise: str
    byte: Any


class State:
    """A saved state, and the inputs on straight lines that belong to it.

    Parameters
    ----------
    handle : ctypes.c_void_p
        The state as the FMU knows it.
    points : numpy.ndarray, optional
        See `InputSlopes`.
    """

    __slots__ = ("handle", "points")

    def __init__(self, handle: c_void_p, points: Vector | None) -> None:
        self.handle = handle
        self.points = points


Caller = Callable[..., None]
"""Calls a function of FMI by its name, and raises an error where that fails."""


def serialise(state: State, names: StateFunctions, call: Caller) -> bytes:
    """Return `state` as bytes."""
    size = c_size_t()
    call(names.size, state.handle, byref(size))
    buffer = (names.byte * size.value)()
    call(names.serialise, state.handle, buffer, size)
    return bytes(buffer) + (b"" if state.points is None else state.points.tobytes())


def deserialise(
    data: bytes, names: StateFunctions, call: Caller, *, shape: tuple[int, ...] | None
) -> State:
    """Return the state in `data`, with points of that `shape` if it has any."""
    points = None
    if shape is not None:
        size = 8 * int(np.prod(shape))
        points = np.frombuffer(data[len(data) - size :]).reshape(shape)
        data = data[: len(data) - size]
    handle, buffer = c_void_p(), (names.byte * len(data)).from_buffer_copy(data)
    call(names.deserialise, buffer, len(data), byref(handle))
    return State(handle, points)
