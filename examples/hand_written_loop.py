"""Couple both FMUs in a loop of one's own, with fmpy alone.

The contact force over a step is extrapolated on a straight line, the track takes its step, then
the vehicle takes its own with the new rail displacement (Gauss-Seidel). Nothing is repeated, so
the step has to be small: at 50 us this explicit scheme is unstable. `railcosim run` iterates and
rejects steps instead.

    .venv/bin/python examples/hand_written_loop.py dist/Track.fmu dist/Vehicle.fmu
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

SPEED = 40.0 / 3.6  # m/s
START, STOP = 15.3, 17.4  # m, of the leading wheel; its flat meets the rail at 16.6 m
STEP = 2.5e-5  # s
WHEELS = (1, 2)


class Slave:
    """An instance of an FMU whose variables are known by name."""

    def __init__(self, path: str, name: str) -> None:
        description = read_model_description(path)
        self.folder = extract(path)
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.setBoolean([self.reference["linear_inputs"]], [True])

    def set(self, names: Sequence[str], values: Sequence[float]) -> None:
        """Set Real variables."""
        self.fmu.setReal([self.reference[name] for name in names], values)

    def get(self, names: Sequence[str]) -> list[float]:
        """Get Real variables."""
        values: list[float] = self.fmu.getReal([self.reference[name] for name in names])
        return values

    def close(self) -> None:
        """End and remove the instance."""
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder)


def passage(track_path: str, vehicle_path: str) -> list[tuple[float, ...]]:
    """Let a bogie with a wheel flat pass; returns rows of time [s], contact forces 1 and 2 [N]."""
    position, force, rail = (
        [f"wheel[{i}].{quantity}" for i in WHEELS]
        for quantity in ("position", "contact_force", "rail_displacement")
    )
    track, vehicle = Slave(track_path, "track"), Slave(vehicle_path, "vehicle")
    track.set(["initial_speed"], [SPEED])
    vehicle.set(["speed", "initial_position"], [SPEED, START])

    # at the start the forces are static: vehicle -> track -> vehicle settles in one round
    track.fmu.enterInitializationMode()
    vehicle.fmu.enterInitializationMode()
    track.set(position + force, vehicle.get(position + force))
    vehicle.set(rail, track.get(rail))
    track.fmu.exitInitializationMode()
    vehicle.fmu.exitInitializationMode()

    now = before = vehicle.get(force)
    start = vehicle.get(position)
    rows = [(0.0, *now)]
    for k in range(round((STOP - START) / SPEED / STEP)):
        ahead = [x + SPEED * STEP * (k + 1) for x in start]
        predicted = [max(2.0 * b - a, 0.0) for a, b in zip(before, now, strict=True)]
        track.set(position + force, ahead + predicted)
        track.fmu.doStep(k * STEP, STEP)
        vehicle.set(rail, track.get(rail))
        vehicle.fmu.doStep(k * STEP, STEP)
        before, now = now, vehicle.get(force)
        rows.append(((k + 1) * STEP, *now))
    track.close()
    vehicle.close()
    return rows


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} TRACK.fmu VEHICLE.fmu")
    largest = max(row[1] for row in passage(*sys.argv[1:3]))
    print(f"largest contact force: {largest / 1e3:.1f} kN")
