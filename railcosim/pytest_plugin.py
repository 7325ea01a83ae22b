"""The pytest fixture `baseline`: results of a test held against what they were.

pytest loads this in every project of an environment that has railcosim, so nothing heavy is
imported before a test uses the fixture.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .comparison import Comparison, Recording, Source, Tolerances

UPDATE = "--update-baselines"
WRITTEN = "railcosim baseline"
"""Under what name the report of a test says which baseline it wrote."""

_owners = pytest.StashKey[dict[Path, str]]()


@dataclass(frozen=True, slots=True, kw_only=True)
class Baseline:
    """What the fixture `baseline` gives a test.

    Attributes
    ----------
    folder : Path
        Where baselines are kept.
    name : str
        Name of the test, that of its baseline unless another one is given.
    update : bool
        Whether missing and differing baselines are written.
    evidence : callable
        Returns a folder for what belongs to a failure.
    written : callable
        Told of a baseline before it is written; refuses that of another test.
    """

    folder: Path
    name: str
    update: bool
    evidence: Callable[[], Path] = field(repr=False)
    written: Callable[[Path], None] = field(repr=False)

    def check(
        self,
        result: Source,
        tolerances: Tolerances | Path | str | None = None,
        *,
        name: str | None = None,
        signals: Sequence[str] = (),
    ) -> Comparison | None:
        """Fail the test unless a result agrees with its baseline.

        Parameters
        ----------
        result : xarray.Dataset, structured ndarray of fmpy, str or Path
            The result, or the .nc, .csv or .parquet file that holds it.
        tolerances : Tolerances, Path or str, optional
            What is allowed, or the TOML file that says so; the defaults without.
        name : str, optional
            Name of the baseline, where a test has several or shares one with another.
        signals : sequence of str
            Patterns of the signals that are kept and compared, ``*`` is any text; all without.

        Returns
        -------
        Comparison or None
            What came of it; None where the baseline was just written.

        Raises
        ------
        InputError
            For a result, a baseline or tolerances that cannot be used.
        """
        __tracebackhide__ = True
        from . import comparison as regression  # noqa: PLC0415 - heavy, see the module's docstring
        from .comparison.keeping import check_finite, restrict, write_baseline  # noqa: PLC0415 - likewise

        path = self.folder / f"{name or self.name}.nc"
        new = restrict(regression.record(result), signals)
        if isinstance(tolerances, (str, Path)):
            tolerances = regression.read_tolerances(Path(tolerances))
        if not path.is_file() and not self.update:
            pytest.fail(
                f"there is no baseline {path}: look whether the result is right, then keep it with "
                f"pytest {UPDATE}",
                pytrace=False,
            )
        old = regression.read_recording(path) if path.is_file() else None
        compared = None if old is None else regression.compare(new, old, tolerances)
        if self.update and (compared is None or not compared.agrees or compared.extra):
            check_finite(new)
            self.written(path)
            self.folder.mkdir(parents=True, exist_ok=True)
            write_baseline(new, path)
            return None
        assert compared is not None
        assert old is not None
        if not compared.agrees:
            pytest.fail(self._message(new, old, compared, path), pytrace=False)
        return compared

    def _message(self, new: Recording, old: Recording, compared: Comparison, path: Path) -> str:
        """Keep the result and a figure of what differs, and say where with the table."""
        from . import comparison as regression  # noqa: PLC0415 - heavy, see the module's docstring
        from .comparison.keeping import write_baseline  # noqa: PLC0415 - likewise

        folder = self.evidence()
        kept = folder / path.name
        write_baseline(new, kept)
        figures = regression.write_overlays(new, old, compared, folder / f"{path.stem}.png")
        return "\n".join(
            [
                compared.verdict(),
                regression.comparison_text(compared).rstrip(),
                *(f"figure: {figure}" for figure in figures),
                f"result: {kept}",
                f"If it is right, keep it with pytest {UPDATE}",
            ]
        )


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that writes baselines."""
    parser.getgroup("railcosim").addoption(
        UPDATE,
        action="store_true",
        help="write the baselines that are missing or differ, in place of failing",
    )


@pytest.fixture
def baseline_folder(request: pytest.FixtureRequest) -> Path:
    """Where baselines are kept: `baselines` beside the test; override this to move them."""
    return request.path.parent / "baselines"


@pytest.fixture
def baseline(request: pytest.FixtureRequest, baseline_folder: Path) -> Baseline:
    """Hold results against what they were: ``baseline.check(result)``."""
    owners = request.config.stash.setdefault(_owners, {})

    def written(path: Path) -> None:
        owner = owners.setdefault(path, request.node.nodeid)
        if owner != request.node.nodeid:
            pytest.fail(
                f"{path} is the baseline of {owner}, too: give one of them another name",
                pytrace=False,
            )
        request.node.user_properties.append((WRITTEN, str(path)))

    return Baseline(
        folder=baseline_folder,
        name=re.sub(r"[^\w.-]+", "_", request.node.name).strip("_"),
        update=bool(request.config.getoption(UPDATE)),
        evidence=lambda: request.getfixturevalue("tmp_path"),
        written=written,
    )


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say which baselines were written."""
    reports = [
        report
        for kind in ("passed", "failed")
        for report in terminalreporter.getreports(kind)
        if getattr(report, "when", "") == "call"
    ]
    for report in reports:
        for key, path in report.user_properties:
            if key == WRITTEN:
                terminalreporter.write_line(f"baseline written: {path}")
