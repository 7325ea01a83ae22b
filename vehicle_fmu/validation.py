"""Checks that several parameter classes share; every refusal names value, limit and remedy."""

import math
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]

# The caller's time and the end of the last step may come from different sums of step sizes.
_TIME_TOLERANCE = 1e-9


def require_finite(name: str, value: float, unit: str, remedy: str) -> None:
    """Raise ValueError unless `value` is a finite number."""
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value:g} {unit}; it must be a finite number: {remedy}")


def require_positive(name: str, value: float, unit: str, remedy: str) -> None:
    """Raise ValueError unless `value` is finite and above zero."""
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(
            f"{name} is {value:g} {unit}; it must be a finite number above zero: {remedy}"
        )


def require_not_negative(name: str, value: float, unit: str, remedy: str) -> None:
    """Raise ValueError unless `value` is finite and not below zero."""
    if not (math.isfinite(value) and value >= 0.0):
        shown = f"{value:g} {unit}".rstrip()
        raise ValueError(
            f"{name} is {shown}; it must be a finite number and not negative: {remedy}"
        )


def check_offsets(offsets: tuple[float, ...]) -> None:
    """Raise ValueError unless the offsets [m] of all wheels are finite, that of the first is 0."""
    if not offsets or offsets[0] != 0.0:
        raise ValueError(f"the offsets are {offsets}; the first, of wheel 1, must be 0 m")
    for number, offset in enumerate(offsets, start=1):
        require_finite(f"offset of wheel {number}", offset, "m", "give its way behind wheel 1")


def require_step(time: float, step_size: float, *, reached: float, what: str) -> None:
    """Raise ValueError unless a step goes on from where a model is, to an end that is later.

    Parameters
    ----------
    time, step_size : float
        Start of the step and its length [s].
    reached : float
        Where the model is [s].
    what : str
        The model and its verb, for the message.
    """
    if not math.isclose(time, reached, rel_tol=_TIME_TOLERANCE, abs_tol=_TIME_TOLERANCE):
        raise ValueError(
            f"the step starts at {time!r} s, the {what} at {reached!r} s; "
            "steps must join: restore the state of that time first"
        )
    if not (math.isfinite(time + step_size) and step_size > 0.0):
        raise ValueError(
            f"the step size is {step_size:g} s; it must be a finite number above zero, and so must "
            "be its end"
        )
    if time + step_size == time:
        raise ValueError(
            f"a step of {step_size:g} s from {time!r} s does not move the time on; use a longer one"
        )


def require_position(position: float, time: float) -> None:
    """Raise ValueError unless the `position` of wheel 1 at a time is a finite number [m], [s]."""
    if not math.isfinite(position):
        raise ValueError(
            f"wheel 1 would be at {position:g} m at {time:g} s; use a lower speed or a shorter step"
        )


def checked_table(
    table: str,
    abscissa: tuple[str, npt.ArrayLike],
    ordinate: tuple[str, npt.ArrayLike],
    *,
    least: int,
) -> tuple[FloatArray, FloatArray]:
    """Return the two columns of a table as read-only float64 copies.

    Parameters
    ----------
    table : str
        What the table is, for the error messages.
    abscissa, ordinate : tuple of (str, array_like of shape (n,))
        Name with unit, and values, of each column.
    least : int
        Smallest number of points allowed.

    Returns
    -------
    tuple of ndarray
        Abscissa and ordinate, each of shape (n,).

    Raises
    ------
    ValueError
        If a column is not one-dimensional, the lengths differ, there are fewer than `least`
        points, a value is NaN or infinite, or the abscissa does not increase strictly.
    """
    columns: list[FloatArray] = []
    for name, values in (abscissa, ordinate):
        column = np.array(values, dtype=np.float64)
        if column.ndim != 1:
            raise ValueError(
                f"{table}: {name} has {column.ndim} dimensions; it must be a plain list of numbers"
            )
        if not np.isfinite(column).all():
            bad = int(np.flatnonzero(~np.isfinite(column))[0])
            raise ValueError(
                f"{table}: {name} is {column[bad]:g} at point {bad + 1} of {column.size}; "
                "every value must be finite: remove or repair that point"
            )
        column.flags.writeable = False
        columns.append(column)
    x, y = columns
    if x.size != y.size:
        raise ValueError(
            f"{table}: {x.size} values of {abscissa[0]} but {y.size} of {ordinate[0]}; "
            "the columns must have the same length"
        )
    if x.size < least:
        raise ValueError(f"{table}: {x.size} points; at least {least} are needed")
    if not (np.diff(x) > 0.0).all():
        bad = int(np.flatnonzero(np.diff(x) <= 0.0)[0])
        raise ValueError(
            f"{table}: {abscissa[0]} goes from {x[bad]:g} to {x[bad + 1]:g} at point {bad + 2}; "
            "it must increase from point to point: sort the table and remove duplicates"
        )
    return x, y
