"""Parameters of a track FMU, with the start values of its structure."""

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
SPEED = 40.0 / 3.6  # m/s, as the vehicles have it


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
    middle, offsets = middle_of(structure), [0.0, -0.5, 0.5]
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


def middle_of(structure: TrackParameters) -> float:
    """Middle of the bay behind the middle of the track, the 26th of 50 [m]."""
    return (structure.bays // 2 + 0.5) * structure.sleeper_spacing
