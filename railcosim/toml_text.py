"""TOML files as text and as tables; what is wrong with one is said in a sentence."""

from __future__ import annotations

import json
import tomllib
from typing import TYPE_CHECKING, Any, TypeAlias

from .errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

TomlValue: TypeAlias = bool | float | str | tuple[str, ...]
"""What a key may hold."""


def read_text(path: Path, what: str) -> str:
    """Read a text file, as UTF-8 with or without a mark at its beginning.

    Parameters
    ----------
    path : Path
        The file.
    what : str
        What it is, for the message.

    Raises
    ------
    InputError
        For a file that cannot be read or is no text.
    """
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"the {what} {path} is not valid TOML: {error}; correct it") from error
    except (OSError, ValueError) as error:  # the latter for a path with a null character
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"cannot read the {what} {path}: {reason}; check the path") from error


def parse_toml(text: str, name: str) -> dict[str, Any]:
    """Read the tables of a TOML text.

    Parameters
    ----------
    text : str
        The text.
    name : str
        What it is and where it stands, for the message.

    Raises
    ------
    InputError
        For a text that is no TOML.
    """
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # numbers too long, tables too deep
        raise InputError(f"the {name} is not valid TOML: {error}; correct it") from error


def table_to_toml(name: str, values: Mapping[str, TomlValue | None]) -> str:
    """Write a table under its name; keys without a value are left out."""
    lines = [
        f"{key} = {_toml_value(value)}"
        for key, value in values.items()
        if value is not None and value != ""
    ]
    return "\n".join([f"[{name}]", *lines]) + "\n"


def _toml_value(value: TomlValue) -> str:
    """Write a value so that reading it gives the same one, bit for bit."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return json.dumps(list(value))
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)
