"""The documentation site: built with every warning an error, and what its hooks make."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", folder],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return folder


def page(site, name):
    return (site / name).read_text(encoding="utf-8")


def test_home_is_the_readme(site):
    assert "make run" in page(site, "index.html")


@pytest.mark.parametrize("fmu", ["Track", "Vehicle", "TrackContact", "Masses"])
def test_every_fmu_has_its_variables(site, fmu):
    assert f'id="{fmu.lower()}"' in page(site, "fmu_reference.html")


def test_variables_of_a_kind_share_a_row(site):
    text = page(site, "fmu_reference.html")
    assert "sleeper[1..49].displacement" in text
    assert "sleeper[2].displacement" not in text


def test_formulas_are_drawn_by_the_browser_itself(site):
    text = page(site, "theory.html")
    assert text.count("<math") > 20
    assert "arithmatex" not in text


def test_scripts_that_pages_link_to_are_pages(site):
    assert "def passage(" in re.sub(
        r"<[^>]+>", "", page(site, "files/examples/contact_on_track.py.html")
    )


LOADED = re.compile(
    r'<(?:script|img|iframe)[^>]+src="https?:[^"]+"'
    r'|<link(?=[^>]+rel="(?:stylesheet|preconnect|icon)")[^>]+href="https?:[^"]+"'
)


def test_pages_load_nothing_from_elsewhere(site):
    pages = list(site.rglob("*.html"))
    assert len(pages) > 10
    assert [page.name for page in pages if LOADED.search(page.read_text(encoding="utf-8"))] == []
