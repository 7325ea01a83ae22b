"""How much two results may differ, signal by signal, from a small TOML file."""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any

from ..errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

TIME_FRACTION = 1e-5
"""Tolerance in time where none is given, over the compared interval."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """What is allowed for one signal.

    Attributes
    ----------
    value : float
        Height of the tube to each side, over the range of the baseline.
    absolute : float
        The same in the unit of the signal; the larger of the two counts.
    time : float or None
        Width of the tube to each side [s]; a hundred-thousandth of the compared interval if None.
    nrms : float
        Largest root mean square of the difference, over the range of the baseline.
    peak : float
        Largest difference of the values of largest magnitude, over that of the baseline.
    shift : float
        Longest lag [s].

    Raises
    ------
    InputError
        For a value that is no number or below 0.
    """

    value: float = 1e-3
    absolute: float = 0.0
    time: float | None = None
    nrms: float = math.inf
    peak: float = math.inf
    shift: float = math.inf

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            if not (value is None and item.name == "time"):
                _check_number(f"the tolerance {item.name}", value)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerances:
    """What is allowed for a whole result.

    Attributes
    ----------
    default : Tolerance
        For every signal.
    signals : mapping of str to mapping of str to float
        Keys of `Tolerance` for the signals that a pattern matches, in which ``*`` stands for any
        text and ``?`` for any character; where several match, later ones replace what earlier
        ones say.
    ignore : tuple of str
        Patterns of signals that are not compared.
    interval : float or None
        How much start and end of the results may differ [s], infinity to compare what both have
        in common; the default's `time` if None.

    Raises
    ------
    InputError
        For an unknown key or a value that does not fit.
    """

    default: Tolerance = field(default_factory=Tolerance)
    signals: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    ignore: tuple[str, ...] = ()
    interval: float | None = None

    def __post_init__(self) -> None:
        if self.interval is not None:
            _check_number("the tolerance interval", self.interval)
        for pattern, changes in self.signals.items():
            _check_keys(f'signals."{pattern}"', changes, _names(Tolerance))
            replace(self.default, **changes)

    def of(self, name: str) -> Tolerance:
        """Return what is allowed for a signal."""
        tolerance = self.default
        for pattern, changes in self.signals.items():
            if matches(name, pattern):
                tolerance = replace(tolerance, **changes)
        return tolerance

    def ignores(self, name: str) -> bool:
        """Tell whether a signal is not compared."""
        return any(matches(name, pattern) for pattern in self.ignore)


def read_tolerances(path: Path) -> Tolerances:
    """Read a file of tolerances.

    Parameters
    ----------
    path : Path
        TOML file with the keys ``interval`` and ``ignore`` and the tables ``[default]`` and
        ``[signals."PATTERN"]``, all of them optional.

    Raises
    ------
    InputError
        For a missing or malformed file, an unknown key or a value that does not fit.
    """
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(
            f"cannot read the tolerances {path}: {error.strerror or error}; check the path"
        ) from error
    except (ValueError, RecursionError) as error:
        raise InputError(
            f"the tolerances {path} are no valid TOML: {error}; correct them"
        ) from error
    try:
        return _from_tables(tables)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def matches(name: str, pattern: str) -> bool:
    """Tell whether a name is of a pattern; brackets stand for themselves, names have them."""
    expression = re.escape(pattern).replace(r"\*", ".*").replace(r"\?", ".")
    return re.fullmatch(expression, name, re.DOTALL) is not None


def _from_tables(tables: Mapping[str, Any]) -> Tolerances:
    """Check the shape of a parsed file; the values check themselves."""
    _check_keys("the file", tables, _names(Tolerances))
    default = _table("default", tables.get("default", {}))
    _check_keys("default", default, _names(Tolerance))
    patterns = _table("signals", tables.get("signals", {}))
    ignore = tables.get("ignore", [])
    if not isinstance(ignore, list) or not all(isinstance(item, str) for item in ignore):
        raise InputError(f"ignore is {ignore!r} but must be a list of patterns in quotes")
    return Tolerances(
        default=Tolerance(**default),
        signals={name: _table(f'signals."{name}"', keys) for name, keys in patterns.items()},
        ignore=tuple(ignore),
        interval=tables.get("interval"),
    )


def _table(name: str, value: object) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InputError(f"{name} is {value!r} but must be a table: write [{name}] above its keys")
    return value


def _names(kind: type[Any]) -> tuple[str, ...]:
    return tuple(item.name for item in fields(kind))


def _check_keys(where: str, keys: Mapping[str, Any], allowed: tuple[str, ...]) -> None:
    for key in keys:
        if key not in allowed:
            raise InputError(
                f"{key!r} is no key of {where}, which may have {', '.join(allowed)}; a pattern "
                'stands in quotes, as in [signals."wheel[*"]'
            )


def _check_number(what: str, value: object) -> None:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not (number and value >= 0.0):  # type: ignore[operator]  # a number by now; NaN is refused
        raise InputError(f"{what} is {value!r} but must be a number from 0 up, or inf")
