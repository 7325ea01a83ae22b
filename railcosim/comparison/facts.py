"""What results say about themselves: attributes and numbers that differ, as information."""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

ALWAYS_DIFFERENT = frozenset({"wall_time"})
"""What no two runs have in common."""

LONGEST = 120
"""Characters of a value that are kept."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FactDifference:
    """An attribute, or a line of one, that differs.

    Attributes
    ----------
    name : str
        The attribute.
    result, baseline : str
        Its values, of several lines those that differ; shortened if long.
    """

    name: str
    result: str
    baseline: str


def differing_facts(
    result: Mapping[str, str], baseline: Mapping[str, str]
) -> tuple[FactDifference, ...]:
    """Return what both say, and say differently.

    Parameters
    ----------
    result, baseline : mapping of str to str
        Attributes by name.
    """
    return tuple(
        _difference(name, result[name], baseline[name])
        for name in baseline
        if name in result and result[name] != baseline[name] and name not in ALWAYS_DIFFERENT
    )


def _difference(name: str, result: str, baseline: str) -> FactDifference:
    """Keep the lines that differ, as of a scenario."""
    lines = list(difflib.ndiff(baseline.splitlines(), result.splitlines()))
    new = "; ".join(line[2:] for line in lines if line.startswith("+ "))
    old = "; ".join(line[2:] for line in lines if line.startswith("- "))
    return FactDifference(name=name, result=_shortened(new), baseline=_shortened(old))


def _shortened(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
