"""Couple a track that has the contacts with wheel masses, in a plain loop with fmpy alone.

At every communication point the outputs of both FMUs go to the inputs of the other one, then both
take a step (Jacobi). Nothing is extrapolated, iterated or repeated here, yet the peak force is
right to 0.1 % at 100 us: the FMUs continue their inputs over the step themselves.

    .venv/bin/python examples/contact_on_track.py dist/TrackContact.fmu dist/Masses.fmu
"""

from __future__ import annotations

import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

SPEED = 40.0 / 3.6  # m/s
START, STOP = 15.3, 17.4  # m, of the leading wheel; its flat meets the rail at 16.6 m
STEP = 1e-4  # s
WHEELS = (1, 2)


class Slave:
    """An instance of an FMU in initialisation mode, with its exchanged variables."""

    def __init__(
        self, path: str, *, start: dict[str, float], inputs: list[str], outputs: list[str]
    ) -> None:
        description = read_model_description(path)
        reference = {v.name: v.valueReference for v in description.modelVariables}
        self.folder = extract(path)
        self.inputs = [reference[name] for name in inputs]
        self.outputs = [reference[name] for name in outputs]
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self.fmu.instantiate()
        self.fmu.setReal([reference[name] for name in start], list(start.values()))
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()

    def read(self) -> list[float]:
        """Outputs."""
        values: list[float] = self.fmu.getReal(self.outputs)
        return values

    def write(self, values: list[float]) -> None:
        """Set the inputs."""
        self.fmu.setReal(self.inputs, values)

    def close(self) -> None:
        """End and remove the instance."""
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder)


def passage(track_path: str, masses_path: str) -> list[tuple[float, ...]]:
    """Let a bogie with a wheel flat pass; returns rows of time [s], contact forces 1 and 2 [N]."""
    motion = [f"wheel[{i}].{name}" for name in ("position", "displacement") for i in WHEELS]
    force = [f"wheel[{i}].contact_force" for i in WHEELS]
    track = Slave(track_path, start={"initial_speed": SPEED}, inputs=motion, outputs=force)
    start = {"speed": SPEED, "initial_position": START}
    masses = Slave(masses_path, start=start, inputs=force, outputs=motion)

    # both start in static equilibrium: passing the values once is all it takes
    track.write(masses.read())
    masses.write(track.read())
    track.fmu.exitInitializationMode()
    masses.fmu.exitInitializationMode()

    rows = [(0.0, *track.read())]
    for k in range(round((STOP - START) / SPEED / STEP)):
        moved, pressed = masses.read(), track.read()
        track.write(moved)
        masses.write(pressed)
        track.fmu.doStep(k * STEP, STEP)
        masses.fmu.doStep(k * STEP, STEP)
        rows.append(((k + 1) * STEP, *track.read()))
    track.close()
    masses.close()
    return rows


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} TRACK_CONTACT.fmu MASSES.fmu")
    largest = max(row[1] for row in passage(*sys.argv[1:3]))
    print(f"largest contact force: {largest / 1e3:.1f} kN")
