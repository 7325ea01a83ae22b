"""The page of a scenario's keys: it names every key there is, and no other."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from railcosim.scenario_file import SECTIONS

DOCS = Path(__file__).resolve().parents[2] / "docs"


def keys_in_tables(page):
    """Names in the first column of all tables, ``.name`` in the section of the name before."""
    found = set()
    for line in (DOCS / page).read_text(encoding="utf-8").splitlines():
        section = ""
        for name in re.findall(r"`([a-z_.]+)`", line.split("|")[1] if line[:1] == "|" else ""):
            section = name.partition(".")[0] or section
            found.add(section + name if name.startswith(".") else name)
    return found


def keys_of(section):
    return {item.name for item in fields(SECTIONS[section])}


@pytest.mark.parametrize("section", sorted(set(SECTIONS) - {"variation"}))
def test_every_key_has_its_row(section):
    named = keys_in_tables("scenario.md")
    own = {name.partition(".")[2] for name in named if name.startswith(f"{section}.")}
    assert own == keys_of(section)


def test_keys_of_a_variation_are_on_the_page_of_supports():
    assert keys_of("variation") == {
        name for name in keys_in_tables("supports.md") if "factor" not in name
    } | {"transition_factor"}


def test_keys_of_sleepers_that_bend_are_on_their_page():
    ours = keys_of("track")
    beam = {name for name in ours if name.startswith("sleeper")}
    rigid = {"sleeper_mass", "sleeper_spacing"}
    assert {f"track.{name}" for name in beam - rigid} == keys_in_tables("sleepers.md")
