"""Small slaves and the steps that tests take them through."""

import numpy as np

STATIC_LOAD = 117_720.0
STEP = 1e-4
SMALL = {"mode_pairs": 40, "linear_inputs": True, "gauge[1].position": 3.9}
NEAR = {"wheel[1].position": 3.9, "wheel[1].contact_force": STATIC_LOAD}


def small_track(open_fmu, small_fmus, **values):
    return open_fmu(small_fmus.track, **(SMALL | NEAR | values))


def drive_track(track, first, last):
    """Steps with a force that depends on the step number alone."""
    for k in range(first, last):
        track.set("wheel[1].position", 3.9 + 1e-3 * (k + 1))
        track.set("wheel[1].contact_force", STATIC_LOAD * (1.0 + 0.3 * np.sin(0.1 * (k + 1))))
        track.fmu.doStep(k * STEP, STEP)


def drive_vehicle(vehicle, first, last):
    for k in range(first, last):
        vehicle.set("wheel[1].rail_displacement", 1e-3 * np.sin(0.02 * (k + 1)))
        vehicle.fmu.doStep(k * STEP, STEP)


DRIVES = {"track": drive_track, "vehicle": drive_vehicle}


def open_small(kind, open_fmu, small_fmus):
    if kind == "track":
        return small_track(open_fmu, small_fmus)
    return open_fmu(small_fmus.vehicle, **{"linear_inputs": True, "flat.position": 12.75})
