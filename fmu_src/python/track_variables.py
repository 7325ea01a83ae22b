"""Variables of the track FMU."""

from __future__ import annotations

from track_fmu.ballast import PolynomialBallast
from track_fmu.parameters import TrackParameters
from track_fmu.track_model import TrackOptions

from .supports import SUPPORT_PARAMETERS
from .variables import Variable

# name, unit, description of the parameters of Table 1
TABLE_1 = (
    ("bending_stiffness", "N.m2", "Bending stiffness EI of the rail"),
    ("shear_stiffness", "N", "Shear stiffness kAG of the rail"),
    ("mass_per_length", "kg/m", "Mass of the rail per unit length"),
    ("rotary_inertia_per_length", "kg.m", "Rotary inertia of the rail per unit length"),
    ("pad_stiffness", "N/m", "Linear stiffness of a rail pad"),
    ("pad_damping", "N.s/m", "Linear viscous damping of a rail pad"),
    ("sleeper_mass", "kg", "Mass of half a sleeper that is rigid"),
    ("sleeper_spacing", "m", "Distance between sleepers"),
    ("ballast_stiffness", "N/m", "Linear stiffness of ballast and subgrade under a rail seat"),
    ("ballast_damping", "N.s/m", "Linear viscous damping of ballast and subgrade"),
)
# likewise of sleepers that bend; those without a unit are no real numbers
SLEEPER = (
    ("sleeper", "", "What sleepers are: rigid, or beam on ballast spread evenly along it"),
    ("sleeper_half_length", "m", "Distance of a beam sleeper's end from its centre"),
    ("sleeper_rail_seat", "m", "Distance of a beam sleeper's rail seat from its centre"),
    ("sleeper_bending_stiffness", "N.m2", "Bending stiffness EI of a beam sleeper"),
    ("sleeper_shear_stiffness", "N", "Shear stiffness kAG of a beam sleeper"),
    ("sleeper_mass_per_length", "kg/m", "Mass of a beam sleeper per unit length"),
    (
        "sleeper_rotary_inertia_per_length",
        "kg.m",
        "Rotary inertia of a beam sleeper per unit length",
    ),
    ("sleeper_elements", "", "Number of beam elements in half a beam sleeper"),
)
APPROACH = 3.875  # m before the middle of the track; the demonstration example starts at 12.7 m
AXLE_BASE = 1.8  # m
SPEED = 40.0 / 3.6  # m/s, as the vehicles have it
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


def track_parameters(structure: TrackParameters, gauges: int) -> list[Variable]:
    """Parameters of a track, wherever its contacts are."""
    variables = [
        Variable(
            name=name,
            causality="parameter",
            unit=unit,
            start=getattr(structure, name),
            minimum=0.0 if unit else None,
            description=description,
        )
        for name, unit, description in (*TABLE_1, *SLEEPER)
    ]
    law, options = PolynomialBallast(), TrackOptions()
    variables.append(
        Variable(
            name="ballast",
            causality="parameter",
            start="state_dependent",
            description="Ballast law: state_dependent (Nielsen & Oscarsson 2004, Eq. 27 and 30, "
            "on top of the linear ballast), linear, hyperbolic (Eq. 26) or a CSV file with the "
            "columns displacement [m] and load [N]",
        )
    )
    variables += [
        Variable(
            name=f"ballast_{name}",
            causality="parameter",
            unit=unit,
            start=getattr(law, name),
            description=f"Coefficient of x^{power} in the state-dependent ballast force (Eq. 27)",
        )
        for name, unit, power in (("alpha", "N/m2", 2), ("beta", "N/m3", 3), ("delta", "N/m4", 4))
    ]
    variables += [
        Variable(
            name="mode_pairs",
            causality="parameter",
            start=min(3 * structure.bays, 2 * (structure.elements - 1) + structure.supports),
            description="Number of retained pairs of complex modes",
        ),
        Variable(
            name="residual_flexibility",
            causality="parameter",
            start=True,
            description="Whether the quasi-static part of the other modes is accounted for",
        ),
        Variable(
            name="supports_per_wheel",
            causality="parameter",
            start=options.supports_per_wheel,
            description="Number of supports nearest to a wheel whose forces are state-dependent",
        ),
        Variable(
            name="initial_speed",
            causality="parameter",
            unit="m/s",
            start=SPEED,
            description="Speed with which the static deflection moves along at the start: that of "
            "the wheels; 0 for wheels that stand",
        ),
        Variable(
            name="endless",
            causality="parameter",
            start=False,
            description="Whether the track goes on without end in both directions: supports are "
            "then numbered from window_position on, which moves with the wheels by whole bays",
        ),
    ]
    variables += _law_parameters(structure)
    middle, offsets = _middle(structure), [0.0, -0.5, 0.5]
    for k in range(gauges):
        offset = offsets[k] if k < len(offsets) else k - 2.0
        variables.append(
            Variable(
                name=f"gauge[{k + 1}].position",
                causality="parameter",
                unit="m",
                start=min(middle + offset * structure.sleeper_spacing, structure.length),
                minimum=0.0,
                description=f"Track position of bending moment gauge {k + 1}",
            )
        )
    return variables


def _law_parameters(structure: TrackParameters) -> list[Variable]:
    """Laws of pads and ballast beside the paper's, and how they differ from support to support."""
    of_all = (
        ("ballast_slope", 2e3, "1/m", 0.0,
         "Rise of the secant stiffness of hyperbolic ballast with its load (Eq. 26)"),
        ("ballast_tangent_damping", False, "", None,
         "Whether the ballast's damping follows its tangent stiffness; false: its secant (Eq. 30)"),
        ("ballast_pulls", True, "", None,
         "Whether the ballast pulls a lifted sleeper back; false: the sleeper lifts off"),
        ("pad", "linear", "", None,
         ("Rail pad law: linear, or a CSV file with the columns displacement [m] and load [N], or "
          "preload [N], static stiffness, stiffness [N/m] and damping [N.s/m] of the branch")),
        ("clip_preload", 20e3, "N", 0.0,
         "Preload of a rail pad under the unloaded rail, where its parameters depend on it"),
        ("supports", "", "", None,
         ("CSV file of supports that differ, instead of support[i].*: number (from 1) or position "
          "[m] and any of the others' names as columns; empty: there is none")),
        ("supports_repeat", False, "", None,
         "Whether the table of supports begins anew behind its last one; false: nominal there"),
    )  # fmt: skip
    variables = [
        Variable(
            name=name,
            causality="parameter",
            start=start,
            unit=unit,
            minimum=minimum,
            description=description,
        )
        for name, start, unit, minimum, description in of_all
    ]
    variables += [
        Variable(
            name=f"support[{i + 1}].{name}",
            causality="parameter",
            start=start,
            unit=unit,
            minimum=0.0 if unit else None,
            description=description.format(i + 1),
        )
        for name, start, unit, description in SUPPORT_PARAMETERS
        for i in range(structure.supports)
    ]
    return variables


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
            minimum=0.0,
            start=max(_middle(structure) - APPROACH - i * AXLE_BASE, 0.0),
            description=f"Track position of wheel {i + 1}, from the clamped end of the rail",
        )
        for i in range(wheels)
    ]


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
         "Force on the ballast under sleeper {}, compression positive"),
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


def _middle(structure: TrackParameters) -> float:
    """Middle of the bay behind the middle of the track, the 26th of 50 [m]."""
    return (structure.bays // 2 + 0.5) * structure.sleeper_spacing
