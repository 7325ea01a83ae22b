"""Values known at the start of a step, continued over it from what was given before."""

from __future__ import annotations

from .beam_element import FloatArray


def begin(
    history: FloatArray, ages: FloatArray, value: FloatArray, *, rate: FloatArray, age: float
) -> None:
    """Start with values that have moved at constant rates so far.

    Parameters
    ----------
    history : (3, n) float array
        Values, the newest first; overwritten.
    ages : (2,) float array
        How long before the newest the other two were given [s]; overwritten.
    value, rate : (n,) float array
        The newest, and its change per second.
    age : float
        Any time of the order of a step [s].
    """
    history[0], history[1], history[2] = value, value - age * rate, value - 2.0 * age * rate
    ages[:] = age, 2.0 * age


def remember(history: FloatArray, ages: FloatArray, value: FloatArray, passed: float) -> None:
    """Put a value in front that is given ``passed`` > 0 seconds after the newest one."""
    history[1:] = history[:-1].copy()
    ages[1] = ages[0] + passed
    ages[0] = passed
    history[0] = value


def continued(history: FloatArray, ages: FloatArray, ahead: float) -> FloatArray:
    """Value ``ahead`` seconds after the newest, on the parabola through all three, shape (n,)."""
    newest, second, third = history
    first_age, second_age = float(ages[0]), float(ages[1])
    slope = (newest - second) / first_age
    earlier = (second - third) / (second_age - first_age)
    bend = (slope - earlier) / second_age
    value: FloatArray = newest + ahead * (slope + (ahead + first_age) * bend)
    return value
