"""Inputs of the native FMUs over time, and what to look at."""

import numpy as np
import pytest

both_versions = pytest.mark.parametrize("version", [2, 3])
both = pytest.mark.parametrize("model", ["track", "vehicle", "track_contact", "masses"])
LOAD = 117_720.0  # N, static
STEP = 1e-4


def over_the_track(time):
    """Inputs of the track at a time: position, and force with an oscillation."""
    force = LOAD * (1.0 + 0.2 * np.sin(500.0 * time))
    return {
        "wheel[1].position": 4.0 + 11.0 * time,
        "wheel[2].position": 2.2 + 11.0 * time,
        "wheel[1].contact_force": float(force),
        "wheel[2].contact_force": LOAD,
    }


def under_the_vehicle(time):
    return {f"wheel[{k}].rail_displacement": 1e-3 * float(np.cos(300.0 * time)) for k in (1, 2)}


def on_the_contacts(time):
    """Inputs of a track with contacts: positions, and displacements that keep contact."""
    return {
        "wheel[1].position": 4.0 + 11.0 * time,
        "wheel[2].position": 2.2 + 11.0 * time,
        "wheel[1].displacement": 2e-5 * float(np.sin(500.0 * time)),
        "wheel[2].displacement": 3e-5 * float(np.sin(300.0 * time)),
    }


def on_the_masses(time):
    return {
        f"wheel[{k}].contact_force": LOAD * (1.0 + 0.2 * float(np.sin(500.0 * time)))
        for k in (1, 2)
    }


INPUTS = {
    "track": over_the_track,
    "vehicle": under_the_vehicle,
    "track_contact": on_the_contacts,
    "masses": on_the_masses,
}
OUTPUTS = {
    "track": [
        f"wheel[{k}].{what}" for k in (1, 2) for what in ("rail_displacement", "rail_velocity")
    ],
    "vehicle": [f"wheel[{k}].{what}" for k in (1, 2) for what in ("contact_force", "gap")],
    "track_contact": [f"wheel[{k}].{what}" for k in (1, 2) for what in ("contact_force", "gap")],
    "masses": [f"wheel[{k}].{what}" for k in (1, 2) for what in ("displacement", "velocity")],
}


def put_all(instance, values):
    for name, value in values.items():
        instance.must(instance.put(name, value))


def started(instance, model, **values):
    put_all(instance, INPUTS[model](0.0))
    return instance.start(**values)
