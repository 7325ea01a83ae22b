"""Reading a study from a TOML file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from ..keep_section import Keep, read_keep
from ..scenario_file import LISTS, no_values, put_all
from ..table_lists import numbered
from ..toml_text import parse_toml, read_text
from .random_rows import random_rows
from .ranges import grid_values
from .study import Base, Study, place_key

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from .case import Swept


def read_study(path: Path) -> Study:
    """Read a study; the files that it names are sought beside it.

    Raises
    ------
    InputError
        For a missing or malformed file, an unknown key or a value that does not fit.
    """
    return parse_study(read_text(path, "study"), folder=path.parent, name=f"study {path}")


def parse_study(text: str, *, folder: Path | None = None, name: str = "study") -> Study:
    """Read a study from the text of a study file.

    Parameters
    ----------
    text : str
        TOML with the tables ``base``, ``sweep`` and ``keep``; docs/sweep.md describes them.
    folder : Path, optional
        Where files are sought; the working directory without.
    name : str
        What the text is called in messages.

    Raises
    ------
    InputError
        For an unknown key or a value that does not fit.
    """
    folder = folder or Path.cwd()
    tables = parse_toml(text, name)
    _refuse_unknown(tables, ("base", "sweep", "keep"), "a study")
    base = dict(_table(tables, "base"))
    sweep = _table(tables, "sweep")
    _refuse_unknown(sweep, ("grid", "list", "random"), "[sweep]")
    if "list" in sweep and "random" in sweep:
        raise InputError("sweep.list and sweep.random are both given: leave one of them out")
    base_text = _base_text(base.get("scenario"), folder)
    common = _base(base, base_text, folder)
    return Study(
        text=text,
        base_text=base_text,
        folder=folder,
        base=common,
        grid={
            key: grid_values(key, given)
            for key, given in _flat(_table(sweep, "grid"), "sweep.grid", folder).items()
        },
        rows=_rows(sweep, folder),
        keep=_keep(tables, common),
    )


def _base_text(path: object, folder: Path) -> str:
    """Read the scenario file of the base, if it has one."""
    if path is None:
        return ""
    if not isinstance(path, str):
        raise InputError(f"base.scenario is {path!r} but must be the path of a scenario file")
    return read_text(folder / Path(path).expanduser(), "scenario")


def _base(given: dict[str, Any], text: str, folder: Path) -> Base:
    """Put the keys beside a scenario file's over its own."""
    values, options = no_values(), dict[str, Any]()
    path = given.pop("scenario", None)
    if path is not None:
        file = folder / Path(path).expanduser()
        put_all(values, parse_toml(text, f"scenario {file}"), file.parent)
    put_all(values, {name: given.pop(name) for name in LISTS if name in given}, folder)
    for name, value in _flat(given, "base", folder).items():
        place_key(values, options, name, value, folder)
    return Base(values=values, options=options)


def _rows(sweep: Mapping[str, Any], folder: Path) -> tuple[Mapping[str, Swept], ...]:
    """Return the cases that are listed or drawn."""
    if "random" in sweep:
        given = dict(_table(sweep, "random"))
        count, seed = given.pop("count", None), given.pop("seed", None)
        return random_rows(_flat(given, "sweep.random", folder), count=count, seed=seed)
    listed = sweep.get("list", [])
    if not isinstance(listed, list):
        raise InputError("sweep.list must be written as [[sweep.list]], once for every case")
    rows = [_flat(_as_table(row, "sweep.list"), "sweep.list", folder) for row in listed]
    for number, row in enumerate(rows, start=1):
        if not row or set(row) != set(rows[0]):
            raise InputError(
                f"case {number} of sweep.list gives {', '.join(row) or 'nothing'} but case 1 "
                f"{', '.join(rows[0]) or 'nothing'}: give the same keys in every one"
            )
    return tuple(rows)


def _keep(tables: Mapping[str, Any], base: Base) -> Keep:
    """Return what the study keeps of every case, or else the scenario that it names."""
    return read_keep(_table(tables, "keep")) if "keep" in tables else Keep(**base.values["keep"])


def _flat(tables: Mapping[str, Any], where: str, folder: Path) -> dict[str, Any]:
    """Name the keys of nested tables ``section.key``; unknown ones are refused."""
    flat = {
        f"{section}.{key}": value
        for section, keys in tables.items()
        for key, value in _as_table(keys, f"{where}.{section}").items()
    }
    for name in flat:
        if numbered(name.partition(".")[0]) is None:  # those are checked with the case they are of
            place_key(no_values(), {}, name, None, folder)
    return flat


def _table(tables: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    return _as_table(tables.get(name, {}), name)


def _as_table(value: object, name: str) -> Mapping[str, Any]:
    if isinstance(value, dict):
        return value
    raise InputError(
        f"{name} is {value!r} but must be a table; write keys as in vehicle.speed_kmh = ..., "
        "without quotation marks"
    )


def _refuse_unknown(table: Mapping[str, Any], allowed: Collection[str], where: str) -> None:
    for name in table:
        if name not in allowed:
            raise InputError(f"{name} is no key of {where}, which are {', '.join(allowed)}")
