"""The log messages of an FMU, kept instead of printed."""

from collections import deque
from ctypes import c_void_p, cast

from fmpy import calloc, free
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

kept_messages = 5
pythonfmu_echo = ("Fatal py exception encountered", "unknown error")
"""How a message of pythonfmu begins and ends that only repeats that the one before it was fatal."""
status_names = ("ok", "warning", "discard", "error", "fatal", "pending")


class FmuLog:
    """Callback functions for one instance that keep its last messages.

    The logger of FMI 2.0 takes printf arguments, which Python callbacks cannot receive. fmpy's
    native formatter can, but serves one logger per process and would read past the end of
    messages with a per cent sign in them, so that messages are kept as they are.

    Attributes
    ----------
    callbacks : fmpy.fmi2.fmi2CallbackFunctions
        What `fmi2Instantiate` gets; it must live as long as the instance.
    messages : collections.deque of str
        Last messages, oldest first.
    """

    def __init__(self) -> None:
        self.messages: deque[str] = deque(maxlen=kept_messages)
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._keep)
        allocate, release = cast(calloc, c_void_p).value, cast(free, c_void_p).value
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(allocate)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(release)

    def _keep(
        self,
        _environment: int | None,
        _instance: bytes | None,
        status: int,
        _category: bytes | None,
        message: bytes | None,
    ) -> None:
        label = status_names[status] if 0 <= status < len(status_names) else str(status)
        text = " ".join((message or b"").decode("utf-8", errors="replace").split())
        if not (
            self.messages
            and text.startswith(pythonfmu_echo[0])
            and text.endswith(pythonfmu_echo[1])
        ):
            self.messages.append(f"[{label}] {text}")
