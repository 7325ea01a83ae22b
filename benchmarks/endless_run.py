"""What ten kilometres on an endless track cost, beside a passage of 6.5 m on an ordinary one.

    python benchmarks/endless_run.py

At 200 km/h over a random irregularity of FRA class 5 with a flat that strikes once a turn, in steps
of 100 us. The program holds a native TrackContact and two masses; an update is one step of both.
Once all supports are alike, once every one of them has pads and ballast of its own.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded

import subprocess
import tempfile
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from fmu_src.native.compiler import compile_program, this_target
from fmu_src.native.model_resources import track_resource
from track_fmu.parameters import TrackParameters

SOURCE = Path(__file__).with_suffix(".c")
SPEED = 200.0 / 3.6
LONG, SHORT = 10_000.0, 6.5  # m
SUPPORTS = 16_000  # of 10 km and some more
REPEATS = 31
AREA, CUTOFF = 0.2095e-4, 0.8245  # m2 rad/m and rad/m: Federal Railroad Administration, class 5
LONGEST, SHORTEST, DISTANCE = 30.0, 0.6, 0.15  # m: wavelengths and distance of the points


def write_irregularity(path: Path, *, length: float, seed: int) -> None:
    """Write drops with the spectrum S(W) = 0.25 A Wc2 / (W2 (W2 + Wc2)), one-sided, m2/(rad/m)."""
    count = 2 * round(0.5 * length / DISTANCE)
    number = 2.0 * np.pi * np.fft.rfftfreq(count, DISTANCE)
    kept = (number >= 2.0 * np.pi / LONGEST) & (number <= 2.0 * np.pi / SHORTEST)
    density = 0.25 * AREA * CUTOFF**2 / (number[kept] ** 2 * (number[kept] ** 2 + CUTOFF**2))
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, int(kept.sum()))
    lines = np.zeros(number.size, dtype=complex)
    lines[kept] = 0.5 * count * np.sqrt(2.0 * density * number[1]) * np.exp(1j * phase)
    drop = np.fft.irfft(lines, count)
    place = DISTANCE * np.arange(count)
    np.savetxt(path, np.column_stack((place, drop)), delimiter=",", fmt=("%.2f", "%.9e"))


def write_supports(path: Path, *, count: int, seed: int) -> None:
    """Write pads and ballast with log-normal stiffness and damping."""
    own = np.exp(0.3 * np.random.default_rng(seed).standard_normal((count, 2)))
    parts, kinds = ("pad", "ballast"), ("stiffness", "damping")
    names = [f"{part}_{kind}_factor" for part in parts for kind in kinds]
    table = np.column_stack((np.arange(1, count + 1), np.repeat(own, 2, axis=1)))
    header = ",".join(("number", *names))
    np.savetxt(path, table, delimiter=",", header=header, comments="", fmt=("%d", *["%.6f"] * 4))


def measure(folder: Path) -> dict[str, dict[str, str]]:
    """Figures of the ordinary passage, of an endless one as short, and of the long run."""
    program, resource, rail = folder / "run", folder / "track.bin", folder / "rail.csv"
    program.write_bytes(compile_program("track_contact", this_target(), main=SOURCE))
    program.chmod(0o755)
    resource.write_bytes(
        track_resource(TrackParameters(), wheels=2, gauges=3, mode_pairs=150, contact=True)
    )
    write_irregularity(rail, length=LONG + 30.0, seed=1)
    tables = {True: str(folder / "all.csv"), False: str(folder / "few.csv")}
    for endless, count in ((True, SUPPORTS), (False, TrackParameters().supports)):
        write_supports(Path(tables[endless]), count=count, seed=2)

    def run(*, endless: bool, distance: float, differing: bool) -> dict[str, str]:
        supports = tables[endless] if differing else ""
        numbers = map(str, (int(endless), SPEED, distance))
        command = [program, resource, rail, supports, *numbers]
        answer = subprocess.run(command, check=True, capture_output=True, text=True)
        return dict(line.split() for line in answer.stdout.splitlines())

    def usual(*, endless: bool, differing: bool) -> dict[str, str]:
        found = [run(endless=endless, distance=SHORT, differing=differing) for _ in range(REPEATS)]
        return sorted(found, key=lambda figures: float(figures["update"]))[REPEATS // 2]

    figures = {}
    for differing, kind in ((False, ""), (True, ", differing")):
        figures |= {
            f"6.5 m, ordinary{kind}": usual(endless=False, differing=differing),
            f"6.5 m, endless{kind}": usual(endless=True, differing=differing),
            f"10 km, endless{kind}": run(endless=True, distance=LONG, differing=differing),
        }
    return figures


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as name:
        figures = measure(Path(name))
    table = Table("", *figures)
    for what in next(iter(figures.values())):
        table.add_row(what.replace("_", " "), *(column[what] for column in figures.values()))
    Console().print(table)


if __name__ == "__main__":
    main()
