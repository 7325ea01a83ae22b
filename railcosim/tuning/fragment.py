"""A fitted track as a scenario file."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from ..output import replacing
from ..toml_text import table_to_toml
from ..track_section import Track

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from .estimate import Estimate


def write_fragment(
    path: Path, track: Track, *, estimates: Collection[Estimate], source: str
) -> None:
    """Write a section ``[track]`` that `railcosim run` reads: what was fitted or is no default.

    Parameters
    ----------
    path : Path
        TOML file.
    track : Track
        The fitted track.
    estimates : collection of Estimate
        What was fitted; their intervals become comments.
    source : str
        What it was fitted to.

    Raises
    ------
    RunError
        Where it cannot be written.
    """
    fitted = [item.name for item in estimates]
    keys = [
        item.name
        for item in fields(Track)
        if item.name in fitted or getattr(track, item.name) != item.default
    ]
    lines = [f"# fitted to {source!r}; 95 % confidence intervals:"]
    lines += [f"#   {e.name} {e.low:.5g} to {e.high:.5g} {e.unit}" for e in estimates]
    lines.append(table_to_toml("track", {key: getattr(track, key) for key in keys}))
    with replacing(path) as temporary:
        temporary.write_text("\n".join(lines), encoding="utf-8")
