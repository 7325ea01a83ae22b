"""The fields of a section of a scenario file, checked against the rules in their annotations."""

from __future__ import annotations

from dataclasses import MISSING, Field, fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, get_args, get_origin, get_type_hints

from .errors import InputError
from .field_rules import Choice, CsvFile, Number, Numbers, is_csv

if TYPE_CHECKING:
    from _typeshed import DataclassInstance


LONGEST = 10**300
"""Integers from here on are no numbers: they do not fit into a float."""


LONGEST_SHOWN = 80
"""Characters of a wrong value that a message repeats."""


def holds_file(section: type[DataclassInstance], key: str, value: str) -> bool:
    """Tell whether ``value`` is the path of a file, as the key's annotation has it."""
    _, rule = _kind_and_rule(_hints(section)[key])
    named = isinstance(rule, CsvFile) or (isinstance(rule, Choice) and rule.or_csv)
    return named and is_csv(value)


def holds_float(section: type[DataclassInstance], key: str) -> bool:
    """Tell whether a key is a number that need not be whole."""
    kind, _ = _kind_and_rule(_hints(section)[key])
    return float in kind


def absolute_file(
    section: type[DataclassInstance], name: str, value: object, folder: Path
) -> object:
    """Make the path of a file absolute, and return any other value as it is.

    Parameters
    ----------
    section : type of a dataclass
        Has the key.
    name : str
        Key with the name of its section, for the message.
    value : object
        Of the key.
    folder : Path
        Where a relative path begins.

    Raises
    ------
    InputError
        For a path that none can be.
    """
    if not (isinstance(value, str) and holds_file(section, name.rpartition(".")[2], value)):
        return value
    try:
        return str((folder / Path(value).expanduser()).resolve())
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(
            f"{name} is {value[:LONGEST_SHOWN]!r}, which is no usable path ({error})"
        ) from error


def check_fields(section: DataclassInstance, name: str) -> None:
    """Check every field of a section against its annotation; whole numbers become floats where due.

    Parameters
    ----------
    section : dataclass instance
        Its fields are annotated ``Annotated[type, rule]``, a rule of `field_rules`, or plain
        ``bool``.
    name : str
        Name of the section in the file, for the messages.

    Raises
    ------
    InputError
        For a wrong type or a value outside its limits.
    """
    hints = _hints(type(section))
    for item in fields(section):
        value = getattr(section, item.name)
        kind, rule = _kind_and_rule(hints[item.name])
        if value is None and type(None) in kind:
            continue
        key = f"{name}.{item.name}"
        wanted = _type_complaint(value, kind, rule)
        if wanted is None and float in kind:
            value = float(value)
            object.__setattr__(section, item.name, value)
        if wanted is None and rule is not None:
            wanted = rule.complaint(value)
        if wanted is not None:
            shown = (
                rule.show(value)
                if isinstance(rule, Number) and _is_number(value)
                else _shortened(value)
            )
            raise InputError(f"{key} is {shown} but must be {wanted}{_default_hint(item, rule)}")


@cache  # a study builds thousands of sections
def _hints(section: type[DataclassInstance]) -> dict[str, object]:
    return get_type_hints(section, include_extras=True)


def _kind_and_rule(
    hint: object,
) -> tuple[tuple[type, ...], Number | Choice | CsvFile | Numbers | None]:
    """Split an annotation into the types a value may have and the rule it obeys."""
    rule = None
    if get_origin(hint) is Annotated:
        hint, rule = get_args(hint)
    kinds = get_args(hint) or (hint,)
    return kinds, rule


def _is_number(value: object) -> bool:
    """Tell whether a value is a number; TOML's integers may be longer than any float."""
    if isinstance(value, int):
        return not isinstance(value, bool) and abs(value) < LONGEST
    return isinstance(value, float)


def _type_complaint(value: object, kind: tuple[type, ...], rule: object) -> str | None:
    """Say which type is wanted where ``value`` has another one, or None."""
    if bool in kind:
        return None if isinstance(value, bool) else "true or false"
    if float in kind:
        unit = f" in {rule.unit}" if isinstance(rule, Number) and rule.unit else ""
        return None if _is_number(value) else f"a number{unit}"
    if int in kind:
        return None if isinstance(value, int) and _is_number(value) else "a whole number"
    if isinstance(value, str):
        return None
    return rule.complaint("") or "a text" if isinstance(rule, Choice) else "a text"


def _default_hint(item: Field[object], rule: object) -> str:
    """Name the default of a key as the remedy of a wrong value."""
    if item.default is MISSING or item.default is None or item.default == "":
        return ""
    if isinstance(rule, Number) and isinstance(item.default, (int, float)):
        return f" (default {rule.show(item.default)})"
    return f" (default {str(item.default).lower()})"


def _shortened(value: object) -> str:
    """Show a wrong value, however long it is."""
    try:
        text = repr(value)
    except ValueError:  # Python writes whole numbers of up to 4300 digits only
        return "a number too long to show"
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}..."
