"""Reading a scenario from a TOML file and `key=value` texts, and writing a resolved one."""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from . import rail_sections, wheel_sections
from .errors import InputError
from .fields import absolute_file
from .keep_section import Keep
from .master_section import Master
from .presets import PRESETS
from .scenario import Scenario
from .sections import Flat, Run, Surface
from .suspension_section import Suspension
from .table_lists import TableList, numbered
from .toml_text import parse_toml, read_text, table_to_toml
from .track_section import Track
from .variation import Variation
from .vehicle_section import Vehicle

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

SECTIONS: Mapping[str, type[Any]] = {
    "track": Track,
    "variation": Variation,
    "vehicle": Vehicle,
    "suspension": Suspension,
    "flat": Flat,
    "run": Run,
    "master": Master,
    "surface": Surface,
    "keep": Keep,
}
"""Sections of a scenario file and the classes that check them."""

LISTS: Mapping[str, TableList] = {
    name: TableList(name=name, kinds=kinds)
    for name, kinds in (
        (rail_sections.SECTION, rail_sections.KINDS),
        (wheel_sections.SECTION, wheel_sections.KINDS),
    )
}
"""Tables that a scenario file may repeat, as ``[[irregularity]]``."""

KEYS: Mapping[str, tuple[str, ...]] = {
    name: tuple(item.name for item in fields(kind)) for name, kind in SECTIONS.items()
}
"""Keys of every section."""

Values: TypeAlias = dict[str, Any]
"""Of every section a dictionary of its keys, of every list its tables."""


def read_scenario(path: Path | None = None, overrides: Iterable[str] = ()) -> Scenario:
    """Read a scenario; what neither the file nor the overrides give keeps its default.

    Parameters
    ----------
    path : Path, optional
        TOML file; the files it names are sought beside it.
    overrides : iterable of str
        Texts ``section.key=value`` that replace the file's keys, in this order; the files they
        name are sought in the working directory.

    Returns
    -------
    Scenario
        Checked as a whole, with absolute paths.

    Raises
    ------
    InputError
        For a missing or malformed file, an unknown key or a value that does not fit.
    """
    values = no_values()
    if path is not None:
        put_all(values, parse_toml(read_text(path, "scenario"), f"scenario {path}"), path.parent)
    for text in overrides:
        section, key, value = _parse_override(text)
        put(values, section, key, value, Path.cwd())
    return build_scenario(values)


def from_toml(text: str) -> Scenario:
    """Read the text that `to_toml` writes.

    Raises
    ------
    InputError
        For a text that is no TOML, an unknown key or a value that does not fit.
    """
    values = no_values()
    put_all(values, parse_toml(text, "scenario"), Path.cwd())
    return build_scenario(values)


def to_toml(scenario: Scenario) -> str:
    """Write every key that a scenario uses, defaults included; reading it gives the same passage.

    Returns
    -------
    str
        TOML text.
    """
    resolved = scenario.resolved()
    blocks = []
    for name, kind in SECTIONS.items():
        section = getattr(resolved, name)
        if isinstance(section, Keep) and section.is_all:
            continue
        values = {item.name: getattr(section, item.name) for item in fields(kind)}
        blocks.append(table_to_toml(name, values))
    for name in LISTS:
        for item in getattr(resolved, name):
            values = {key.name: getattr(item, key.name) for key in fields(item)}
            blocks.append(table_to_toml(f"[{name}]", {"kind": item.kind} | values))
    return "\n".join(blocks)


def no_values() -> Values:
    """Return the keys of a scenario that gives none."""
    return {name: {} for name in SECTIONS} | {name: [] for name in LISTS}


def build_scenario(values: Values) -> Scenario:
    """Check the keys of a scenario as a whole, above those of its preset if it names one.

    Raises
    ------
    InputError
        For a value that does not fit.
    """
    preset = PRESETS.get(str(values["vehicle"].get("preset")))
    usual: Mapping[str, Mapping[str, Any]] = preset.keys() if preset else {}
    parts: dict[str, Any] = {
        name: kind(**{**usual.get(name, {}), **values[name]}) for name, kind in SECTIONS.items()
    }
    parts |= {name: tuple(map(kind.make, values[name])) for name, kind in LISTS.items()}
    return Scenario(**parts)


def put_all(values: Values, tables: Mapping[str, Any], folder: Path) -> None:
    """Put every key of a parsed file in its place; see `put`."""
    for section, keys in tables.items():
        if section in LISTS:
            values[section] = LISTS[section].read(keys, folder)
            continue
        _check_section(section, keys)
        for key, value in keys.items():
            put(values, section, key, value, folder)


def put(values: Values, section: str, key: str, value: object, folder: Path) -> None:
    """Put a key in its place, the path of a file made absolute.

    Parameters
    ----------
    values : dict
        Keys by section, which gain this one.
    section, key : str
        Which key.
    value : object
        Its value, which `build_scenario` checks.
    folder : Path
        Where a file that it names is sought.

    Raises
    ------
    InputError
        For an unknown key or a path that cannot be one.
    """
    one = numbered(section)
    if one is not None and one[0] in LISTS:
        LISTS[one[0]].put(values[one[0]], one[1], key, value, folder)
        return
    _check_section(section, {})
    if key not in KEYS[section]:
        name = f"{section}.{key}"
        raise InputError(
            f"{name} is no key of a scenario: did you mean {_nearest(name)}, or another key of "
            f"[{section}] ({_listed(KEYS[section])})?"
        )
    values[section][key] = absolute_file(SECTIONS[section], f"{section}.{key}", value, folder)


def _parse_override(text: str) -> tuple[str, str, Any]:
    """Split ``section.key=value``; a value that is no TOML value is a plain text."""
    name, equals, value = text.partition("=")
    section, dot, key = name.strip().partition(".")
    if not (equals and dot):
        raise InputError(
            f"--set {text} is not of the form section.key=value: write for example "
            f"--set {_nearest(name.strip())}=..."
        )
    try:
        return section, key, tomllib.loads(f"value = {value}")["value"]
    except (ValueError, RecursionError):
        return section, key, value.strip()


def _check_section(section: str, keys: object) -> None:
    """Refuse an unknown section, and a value where a section is due."""
    if section in LISTS:
        raise InputError(
            f"{section} is a list of tables: name one of them, as in {section}[1].kind=csv"
        )
    if section not in SECTIONS:
        raise InputError(
            f"{section} is no section of a scenario: did you mean {_nearest(section)}, or another "
            f"key of {_listed(f'[{name}]' for name in SECTIONS)}?"
        )
    if not isinstance(keys, dict):
        raise InputError(
            f"{section} is {keys!r} but must be a section [{section}] with keys of "
            f"{_listed(KEYS[section])}"
        )


def _nearest(name: str) -> str:
    """Find the ``section.key`` that a text resembles most.

    A longer key of the section wins that ends with the key, then the right key in any section.
    """
    words = [f"{section}.{key}" for section, keys in KEYS.items() for key in keys]
    section, _, key = name.rpartition(".")

    def likeness(word: str) -> tuple[bool, bool, float]:
        same_key = word.rpartition(".")[2] == key
        longer_key = word.startswith(f"{section}.") and word.endswith(f"_{key}")
        return longer_key, same_key, difflib.SequenceMatcher(None, name, word).ratio()

    return max(words, key=likeness)


def _listed(words: Iterable[str]) -> str:
    return ", ".join(words)
