"""Every tutorial is executed as it stands, and prints what it says it prints."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from doctest import ELLIPSIS, NORMALIZE_WHITESPACE, OutputChecker
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs" / "tutorials").glob("*.md"))
BLOCK = re.compile(
    r"^```(?P<language>\w+)(?: title=\"(?P<title>[^\"]+)\")?\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
END = "--- end of a block ---"


@dataclass(frozen=True)
class Block:
    language: str
    title: str | None
    text: str


def blocks_of(page):
    return [Block(**block.groupdict()) for block in BLOCK.finditer(page)]


def commands_of(text):
    """Pairs of a command and the output that is shown after it."""
    return [
        (command, shown)
        for command, shown in re.findall(r"^\$ (.+)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE)
    ]


def agree(shown, printed):
    """Whether what is shown, with ``...`` for anything, is what was printed."""
    return OutputChecker().check_output(shown, printed, ELLIPSIS | NORMALIZE_WHITESPACE)


def run(arguments, folder):
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "COLUMNS": "100"}
    return subprocess.run(
        arguments,
        cwd=folder,
        env=environment,
        check=False,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def execute(page, folder):
    """Run a page from top to bottom, its Python blocks as one program at each console."""
    blocks = blocks_of(page)
    session = []
    for block, following in zip(blocks, [*blocks[1:], None], strict=True):
        if block.language == "python":
            shown = following.text if following and following.language == "text" else None
            session.append((block.text, shown))
        elif block.language == "console":
            run_python(session, folder)
            session = []
            for command, shown in commands_of(block.text):
                done = run(["bash", "-c", command], folder)
                assert agree(shown, done.stdout), f"$ {command}\n{done.stdout}"
        elif block.title:
            (folder / block.title).write_text(block.text, encoding="utf-8")
    run_python(session, folder)


def run_python(session, folder):
    """Run blocks as one program; each is compared with the output shown for it."""
    if not session:
        return
    program = f"print({END!r})\n".join(text for text, _ in session)
    (folder / "tutorial.py").write_text(program, encoding="utf-8")
    done = run([sys.executable, "-W", "error", "tutorial.py"], folder)
    assert done.returncode == 0, done.stdout
    for (_, shown), printed in zip(session, done.stdout.split(f"{END}\n"), strict=True):
        assert agree(shown or "", printed), printed


def test_pages_are_found():
    assert len(PAGES) >= 3


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_tutorial_runs_and_prints_what_it_shows(page, tmp_path):
    execute(page.read_text(encoding="utf-8"), tmp_path)


@pytest.mark.parametrize(
    "page",
    [
        "```python\nprint(1)\n```\n```text\n2\n```\n",
        "```python\nprint(1)\n```\n",
        "```python\nraise ValueError\n```\n",
        "```console\n$ echo one\ntwo\n```\n",
    ],
    ids=["other output", "output not shown", "an error", "other output of a command"],
)
def test_a_tutorial_that_is_wrong_is_found(page, tmp_path):
    with pytest.raises(AssertionError):
        execute(page, tmp_path)
