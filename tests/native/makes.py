"""FMUs of tracks and vehicles of every make: size, parameters, and inputs over time."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from railcosim.motion import speed_law
from railcosim.presets import PRESETS
from railcosim.scenario_file import read_scenario
from railcosim.start_values import vehicle_values

PAD = str(Path(__file__).resolve().parents[2] / "examples" / "pad.csv")
SPEED = 50.0  # m/s
LOAD = 117_720.0  # N
BEAM = {"sleeper": "beam", "sleeper_elements": 3, "mode_pairs": 40}

Inputs = Callable[[int, float], Mapping[str, float]]


def forces(wheel, time):
    return {f"wheel[{wheel}].contact_force": LOAD * (1.0 + 0.4 * np.sin(300.0 * time + wheel))}


def on_track(wheel, time):
    return {**forces(wheel, time), f"wheel[{wheel}].position": 4.45 - 0.6 * wheel + SPEED * time}


def on_contacts(wheel, time):
    return {
        f"wheel[{wheel}].displacement": 8e-5 * np.sin(300.0 * time + wheel),
        f"wheel[{wheel}].position": 4.45 - 0.6 * wheel + SPEED * time,
    }


def under_vehicle(wheel, time):
    """The leading bogie runs into a hole of 50 mm; the contacts last."""
    depth = 25e-3 * (1.0 - np.cos(min(200.0 * time, np.pi)))
    return {f"wheel[{wheel}].rail_displacement": float(depth if wheel < 3 else 0.0)}


def on_masses(wheel, time):
    """The leading bogie is let fall."""
    share = 0.0 if wheel < 3 and time > 0.0 else 1.0 + 0.2 * np.sin(300.0 * time)
    return {f"wheel[{wheel}].contact_force": LOAD * share}


@dataclass(frozen=True, kw_only=True)
class Make:
    """An FMU of a pair with its values, and what shall be seen of it where its state is saved."""

    contact: str
    side: str
    inputs: Inputs
    structure: Mapping[str, int] = field(default_factory=dict)
    fixed: Mapping[str, float | str] = field(default_factory=dict)
    values: Mapping[str, float | str] = field(default_factory=dict)
    seen: Callable[[dict, dict], bool] = lambda *_: True

    @property
    def wheels(self):
        return self.structure.get("wheels", 2)


def track(contact, **more):
    inputs = on_track if contact == "vehicle" else on_contacts
    return Make(contact=contact, side="track", inputs=inputs, **more)


def vehicle(contact, **more):
    inputs = under_vehicle if contact == "vehicle" else on_masses
    return Make(contact=contact, side="vehicle", inputs=inputs, **more)


def window_has_moved(first, now):
    return now["window_position"] > first["window_position"]


def sleeper_is_bent(first, now):
    moments = [now[f"sleeper[{k}].bending_moment"] for k in range(1, 12)]
    return np.abs(moments).max() > 1e3 and window_has_moved(first, now)


def sleeper_is_lifted(_, now):
    return min(now[f"sleeper[{k}].displacement"] for k in range(1, 12)) < 0.0


def stop_is_closed(first, now):
    """The springs alone, of at most 1 MN/m, would give a hundred newtons at the clearance."""
    return any(
        abs(now[name] - first[name]) > 1e3 for name in ("secondary[1].force", "secondary[2].force")
    )


ENDLESS = {"endless": True, "initial_speed": SPEED}
RICH = {
    "pad": PAD,
    "ballast_pulls": False,
    "ballast_mass": 60.0,
    "ballast_mass_grows": True,
    "support[6].gap": 5e-4,
    "support[7].sleeper_mass_factor": 0.5,
}
COACH = {"wheels": 4, "bogies": 2}


def coach(name):
    """Parameters of a vehicle of the literature, with bump stops that are near."""
    case = read_scenario(None, (f"vehicle.preset={name}", "flat.position=29"))
    own = vehicle_values(case, speed_law(case.vehicle), "track")
    return own | {"secondary.clearance": 1e-4, "secondary.stop_stiffness": 5e7}


MAKES = {
    f"{name}, {contact}": make(contact, **more)
    for contact in ("vehicle", "track")
    for name, make, more in (
        ("three wheels", track, {"structure": {"wheels": 3}}),
        ("three wheels run", vehicle, {"structure": {"wheels": 3}}),
        ("endless", track, {"values": ENDLESS, "seen": window_has_moved}),
        (
            "endless supports",
            track,
            {"values": {**ENDLESS, "supports": "SUPPORTS"}, "seen": window_has_moved},
        ),
        ("rich", track, {"values": RICH, "seen": sleeper_is_lifted}),
        ("rich endless", track, {"values": RICH | ENDLESS, "seen": window_has_moved}),
        ("beams", track, {"fixed": BEAM, "values": ENDLESS, "seen": sleeper_is_bent}),
        *(
            (preset, vehicle, {"structure": COACH, "values": coach(preset), "seen": stop_is_closed})
            for preset in PRESETS
        ),
    )
}


def values_of(make, kind, supports):
    values = dict(make.values)
    if kind == "python" and make.side == "track":
        values |= {"mode_pairs": 36, **make.fixed}
    return {name: supports if value == "SUPPORTS" else value for name, value in values.items()}
