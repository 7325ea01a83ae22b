"""What the native tracks cost in processor time, on a track of 50 and on one of 200 bays.

    python benchmarks/native_steps.py

The cost of a step grows with the retained modes and not faster. An update is one step of a moving
bogie with a step size that was used before; a repeated one starts from the same state with other
contact forces, or other displacements of the wheels where the contacts are on the track's side.
Least of 100 batches of 200 each.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded

import subprocess
import tempfile
from pathlib import Path

from rich.console import Console
from rich.table import Table

from fmu_src.native.compiler import compile_program, this_target
from fmu_src.native.model_resources import track_resource
from track_fmu.parameters import TrackParameters

SOURCE = Path(__file__).with_suffix(".c")
BAYS = (50, 200)
MODES_PER_BAY = 3
MODELS = {"track": "Track", "track_contact": "TrackContact"}


def measure(folder: Path, model: str) -> dict[int, dict[str, str]]:
    """Nanoseconds by number of bays and what was done."""
    program = folder / model
    program.write_bytes(compile_program(model, this_target(), main=SOURCE))
    program.chmod(0o755)
    return {bays: _run(folder, program, model, bays) for bays in BAYS}


def _run(folder: Path, program: Path, model: str, bays: int) -> dict[str, str]:
    resource = folder / "track.bin"
    resource.write_bytes(
        track_resource(
            TrackParameters(bays=bays),
            wheels=2,
            gauges=3,
            mode_pairs=MODES_PER_BAY * bays,
            contact=model == "track_contact",
        )
    )
    answer = subprocess.run([program, resource], check=True, capture_output=True, text=True)
    return dict(line.split() for line in answer.stdout.splitlines())


def main() -> None:
    """Print the table."""
    table = Table("", *(f"{bays} bays, {MODES_PER_BAY * bays} mode pairs" for bays in BAYS))
    with tempfile.TemporaryDirectory() as name:
        for model, label in MODELS.items():
            times = measure(Path(name), model)
            for what in times[BAYS[0]]:
                row = (f"{float(times[bays][what]) / 1000.0:.2f} us" for bays in BAYS)
                table.add_row(f"{label}: {what.replace('_', ' ')}", *row)
    Console().print(table)


if __name__ == "__main__":
    main()
