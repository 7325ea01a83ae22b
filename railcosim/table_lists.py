"""Tables that a scenario file may repeat, each of a kind with keys of its own."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import TYPE_CHECKING, Any

from .errors import InputError
from .fields import absolute_file

if TYPE_CHECKING:
    from pathlib import Path

NUMBERED = re.compile(r"(\w+)\[(\d+)\]")
"""How an option names one of the tables: ``irregularity[1]``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TableList:
    """The tables of one name.

    Attributes
    ----------
    name : str
        As in the file, ``[[name]]``.
    kinds : mapping of str to class
        What the key ``kind`` may be, and the dataclasses that check the other keys.
    """

    name: str
    kinds: Mapping[str, type[Any]]

    def read(self, tables: object, folder: Path) -> list[dict[str, Any]]:
        """Check the keys of parsed tables, and make the paths in them absolute.

        Raises
        ------
        InputError
            For anything but tables of known kinds with known keys.
        """
        if not (isinstance(tables, list) and all(isinstance(row, dict) for row in tables)):
            raise InputError(
                f"{self.name} is {tables!r} but must be tables [[{self.name}]] with the key kind"
            )
        rows: list[dict[str, Any]] = []
        for table in tables:
            rows.append({"kind": table.get("kind")})
            for key, value in table.items():
                self.put(rows, len(rows), key, value, folder)
        return rows

    def put(
        self, rows: list[dict[str, Any]], number: int, key: str, value: object, folder: Path
    ) -> None:
        """Set a key of the table of this number, counted from 1.

        Raises
        ------
        InputError
            For a table or a key that there is not.
        """
        if not 1 <= number <= len(rows):
            raise InputError(
                f"{self.name}[{number}] is no table of this scenario, which has {len(rows)} of "
                f"that name: add [[{self.name}]] to its file"
            )
        row = rows[number - 1]
        if key == "kind":
            row["kind"] = value
            return
        kind = self._kind(row["kind"])
        keys = [item.name for item in fields(kind)]
        if key not in keys:
            raise InputError(
                f"{self.name}.{key} is no key of the kind {row['kind']}: choose one of "
                f"{', '.join(keys)}"
            )
        row[key] = absolute_file(kind, f"{self.name}.{key}", value, folder)

    def make(self, row: Mapping[str, Any]) -> Any:  # noqa: ANN401 - one of many classes
        """Make the object of a table.

        Raises
        ------
        InputError
            For a key that is missing, or a value that does not fit.
        """
        kind = self._kind(row["kind"])
        for item in fields(kind):
            if item.default is MISSING and item.name not in row:
                raise InputError(
                    f"{self.name}.{item.name} is missing, which the kind {row['kind']} needs: "
                    "give it"
                )
        return kind(**{key: value for key, value in row.items() if key != "kind"})

    def _kind(self, name: object) -> type[Any]:
        if not isinstance(name, str) or name not in self.kinds:
            shown = "missing" if name is None else f"{name!r}"
            raise InputError(
                f"{self.name}.kind is {shown} but must be one of {', '.join(self.kinds)}"
            )
        return self.kinds[name]


def numbered(text: str) -> tuple[str, int] | None:
    """Split ``irregularity[1]`` into name and number, or return None."""
    found = NUMBERED.fullmatch(text)
    return None if found is None else (found[1], int(found[2]))
