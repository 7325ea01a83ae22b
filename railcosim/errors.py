"""The two ways a command can end badly."""

from __future__ import annotations


class InputError(ValueError):
    """What the user gave cannot be used; the command line ends with exit code 2.

    The message is one sentence: what is wrong, the value, the limit, the remedy.
    """


class RunError(RuntimeError):
    """The input was fine and the run still failed; the command line ends with exit code 1.

    The message is one sentence that says where and why.
    """
