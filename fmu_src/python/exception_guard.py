"""Slaves that outlive an exception in one of their methods.

For every exception pythonfmu 0.7 gives back the references to class, instance and log, and once
more when the instance is freed; without another set of references that is a crash.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

GUARDED = (
    "setup_experiment",
    "enter_initialization_mode",
    "exit_initialization_mode",
    "do_step",
    "terminate",
    *(f"{access}_{kind}" for access in ("get", "set") for kind in
      ("real", "integer", "boolean", "string")),
    "_get_fmu_state",
    "_set_fmu_state",
)  # fmt: skip
"""Methods of a slave that pythonfmu's library calls."""

Slave = TypeVar("Slave")


def kept_alive(slave: type[Slave]) -> type[Slave]:
    """Make the guarded methods of a slave class take the missing references when they raise."""
    for name in GUARDED:
        setattr(slave, name, _keeping_alive(getattr(slave, name)))
    return slave


def _keeping_alive(method: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(method)
    def guarded(self: Any, *arguments: Any) -> Any:  # noqa: ANN401 - whatever slave and method it is
        try:
            return method(self, *arguments)
        except Exception:
            for owned in (type(self), self, self.log_queue):
                ctypes.pythonapi.Py_IncRef(ctypes.py_object(owned))
            raise

    return guarded
