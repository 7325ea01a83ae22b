"""Variables of the track FMU: its parameters, what wheels tell it and what it shows of itself."""

from __future__ import annotations

from track_fmu.parameters import TrackParameters

from .track_parameters import middle_of, track_parameters
from .variables import Variable

APPROACH = 3.875  # m before the middle of the track; the demonstration example starts at 12.7 m
AXLE_BASE = 1.8  # m
STATIC_WHEEL_LOAD = 117_720.0  # N


def declare_track(structure: TrackParameters, *, wheels: int, gauges: int) -> list[Variable]:
    """Variables of a track FMU of given size.

    Parameters
    ----------
    structure : TrackParameters
        Size of the track; its other values are the start values.
    wheels, gauges : int
        Number of wheels and of bending moment gauges.
    """
    known = tuple(
        f"wheel[{i}].{name}" for i in range(1, wheels + 1) for name in ("position", "contact_force")
    )
    return [
        *track_parameters(structure, gauges),
        *position_inputs(structure, wheels),
        *_force_inputs(wheels),
        *track_outputs(structure, wheels, gauges, known=known),
    ]


def position_inputs(structure: TrackParameters, wheels: int) -> list[Variable]:
    """Track positions of the wheels."""
    return [
        Variable(
            name=f"wheel[{i + 1}].position",
            causality="input",
            group="position",
            index=i,
            unit="m",
            nominal=1.0,
            start=position,
            description=f"Track position of wheel {i + 1}, from the clamped end of the rail",
        )
        for i, position in enumerate(_start_positions(structure, wheels))
    ]


def _start_positions(structure: TrackParameters, wheels: int) -> list[float]:
    """Start positions of wheels [m], all on the track if it has room for them."""
    middle = middle_of(structure)
    approach = min(APPROACH, 0.5 * (middle - (wheels - 1) * AXLE_BASE))
    return [max(middle - approach - i * AXLE_BASE, 0.0) for i in range(wheels)]


def _force_inputs(wheels: int) -> list[Variable]:
    return [
        Variable(
            name=f"wheel[{i + 1}].contact_force",
            causality="input",
            group="contact_force",
            index=i,
            unit="N",
            nominal=1e5,
            minimum=0.0,
            start=STATIC_WHEEL_LOAD,
            description=f"Contact force of wheel {i + 1} on the rail, compression positive",
        )
        for i in range(wheels)
    ]


def track_outputs(
    structure: TrackParameters, wheels: int, gauges: int, *, known: tuple[str, ...]
) -> list[Variable]:
    """What a track shows of itself, depending at the start on the variables ``known``."""
    supports = structure.supports
    kinds = (
        ("wheel", "rail_displacement", "rail_displacement", wheels, "m", 1e-3,
         "Displacement of the rail under wheel {}, downwards positive"),
        ("wheel", "rail_velocity", "rail_velocity", wheels, "m/s", 1e-1,
         "Rail velocity under wheel {}, following the wheel, downwards positive"),
        ("wheel", "bending_moment", "wheel_moment", wheels, "N.m", 1e4,
         "Bending moment of the rail under wheel {}, sagging positive"),
        ("gauge", "bending_moment", "gauge_moment", gauges, "N.m", 1e4,
         "Bending moment of the rail at gauge {}, sagging positive"),
        ("sleeper", "displacement", "sleeper_displacement", supports, "m", 1e-3,
         "Displacement of sleeper {} at its rail seat, downwards positive"),
        ("pad", "force", "pad_force", supports, "N", 1e4,
         "Force in the rail pad on sleeper {}, compression positive"),
        ("ballast", "force", "ballast_force", supports, "N", 1e4,
         "Force on the ballast under sleeper {} beyond that at rest, compression positive"),
        ("sleeper", "bending_moment", "sleeper_moment", supports, "N.m", 1e3,
         "Bending moment of sleeper {} at its rail seat, sagging positive; 0 where it is rigid"),
        ("sleeper", "centre_bending_moment", "sleeper_centre_moment", supports, "N.m", 1e3,
         "Bending moment of sleeper {} at its centre, sagging positive; 0 where it is rigid"),
    )  # fmt: skip
    outputs = [
        Variable(
            name=f"{part}[{i + 1}].{name}",
            causality="output",
            group=group,
            index=i,
            unit=unit,
            nominal=nominal,
            description=description.format(i + 1),
            initial_dependencies=known,
        )
        for part, name, group, count, unit, nominal, description in kinds
        for i in range(count)
    ]
    window = Variable(
        name="window_position",
        causality="output",
        group="window_position",
        unit="m",
        nominal=1.0,
        description="Where the held part of an endless track begins: sleeper k stands k sleeper "
        "spacings further on; 0 for an ordinary track",
        initial_dependencies=known,
    )
    return [*outputs, window]
