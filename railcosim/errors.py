"""The two ways a command can end badly."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr


class InputError(ValueError):
    """What the user gave cannot be used; the command line ends with exit code 2.

    The message is one sentence: what is wrong, the value, the limit, the remedy.
    """


class RunError(RuntimeError):
    """The input was fine and the run still failed; the command line ends with exit code 1.

    The message is one sentence that says where and why.

    Parameters
    ----------
    message : str
        The sentence.
    result : xarray.Dataset, optional
        What there is of a result, with the attribute ``complete`` 0.
    """

    def __init__(self, message: str, *, result: xr.Dataset | None = None) -> None:
        super().__init__(message)
        self.result = result


class BuildError(RunError):
    """The FMUs cannot be built: a reason that has to do with the machine, not with the scenario."""
