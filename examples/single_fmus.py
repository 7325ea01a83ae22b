"""Each FMU by itself, driven by input signals through fmpy.

The track under a force that moves at 40 km/h, and the vehicle on a rail that sags as it passes.

    .venv/bin/python examples/single_fmus.py dist/Track.fmu dist/Vehicle.fmu
"""

from __future__ import annotations

import sys

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

SPEED = 40.0 / 3.6  # m/s
START = 12.7  # m, leading wheel
STATIC_WHEEL_LOAD = 117_720.0  # N
STEP, STOP = 2e-4, 0.1  # s


def track_under_moving_forces(path: str) -> NDArray[np.void]:
    """Two static wheel loads roll along the track; returns the rail displacement under wheel 1."""
    signals = np.array(
        [
            (time, START + SPEED * time, START - 1.8 + SPEED * time, *2 * [STATIC_WHEEL_LOAD])
            for time in (0.0, STOP)
        ],
        dtype=[
            (name, float)
            for name in (
                "time",
                "wheel[1].position",
                "wheel[2].position",
                "wheel[1].contact_force",
                "wheel[2].contact_force",
            )
        ],
    )
    result: NDArray[np.void] = simulate_fmu(
        path,
        stop_time=STOP,
        step_size=STEP,
        output_interval=STEP,
        start_values={"initial_speed": SPEED},
        input=signals,
        output=["wheel[1].rail_displacement"],
    )
    return result


def vehicle_on_prescribed_rail(path: str) -> NDArray[np.void]:
    """The rail sinks 1 mm and comes back up in 50 ms; returns the contact force of wheel 1."""
    times = np.linspace(0.0, STOP, 501)
    sag = np.where(times < 0.05, 0.5e-3 * (1.0 - np.cos(2.0 * np.pi * times / 0.05)), 0.0)
    signals = np.array(
        list(zip(times, sag, sag, strict=True)),
        dtype=[
            (name, float)
            for name in ("time", "wheel[1].rail_displacement", "wheel[2].rail_displacement")
        ],
    )
    result: NDArray[np.void] = simulate_fmu(
        path,
        stop_time=STOP,
        step_size=STEP,
        output_interval=STEP,
        start_values={"flat.shape": "none"},
        input=signals,
        output=["wheel[1].contact_force"],
    )
    return result


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} TRACK.fmu VEHICLE.fmu")
    track, vehicle = sys.argv[1:3]
    displacement = track_under_moving_forces(track)["wheel[1].rail_displacement"]
    force = vehicle_on_prescribed_rail(vehicle)["wheel[1].contact_force"]
    print(f"rail displacement: {displacement.max() * 1e3:.3f} mm")
    print(f"contact force: {force.max() / 1e3:.1f} kN")
