"""The log messages of an FMU, kept instead of printed."""

from collections import deque

kept_messages = 5
pythonfmu_echo = ("Fatal py exception encountered", "unknown error")
"""How a message of pythonfmu begins and ends that only repeats that the one before it was fatal."""
status_names = ("ok", "warning", "discard", "error", "fatal", "pending")


class FmuLog:
    """Keeps the last messages of one instance.

    Attributes
    ----------
    messages : collections.deque of str
        Last messages, oldest first.
    """

    def __init__(self) -> None:
        self.messages: deque[str] = deque(maxlen=kept_messages)

    def keep(self, status: int, message: bytes | None) -> None:
        """Add a message that came with an FMI status."""
        label = status_names[status] if 0 <= status < len(status_names) else str(status)
        text = " ".join((message or b"").decode("utf-8", errors="replace").split())
        if not (
            self.messages
            and text.startswith(pythonfmu_echo[0])
            and text.endswith(pythonfmu_echo[1])
        ):
            self.messages.append(f"[{label}] {text}")
