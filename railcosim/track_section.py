"""The section `[track]` of a scenario file: every key with its unit, default and limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .errors import InputError
from .field_rules import Choice, CsvFile, Number
from .fields import check_fields

MOST_DEGREES_OF_FREEDOM = 10_000
"""Size of track whose modes fit in a few gigabytes of memory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """Keys of ``[track]``: Table 1 of Nielsen & Oscarsson (2004), and the size of the modal model.

    Attributes
    ----------
    bays, elements_per_bay : int
        Sleeper bays between the clamped ends, beam elements in each.
    bending_stiffness, shear_stiffness : float
        Rail EI [N m2] and kGA [N].
    mass_per_length, rotary_inertia_per_length : float
        Rail m [kg/m] and m r2 [kg m].
    pad_stiffness, pad_damping : float
        Rail pad [N/m], [N s/m].
    sleeper_mass, sleeper_spacing : float
        Half sleeper that is rigid [kg] and spacing [m].
    ballast_stiffness, ballast_damping : float
        Unloaded ballast and subgrade per rail seat [N/m], [N s/m].
    sleeper : str
        ``rigid``, or ``beam``: a Rayleigh-Timoshenko beam on ballast spread evenly along it, with
        the properties that follow.
    sleeper_half_length, sleeper_rail_seat : float
        Distance of a sleeper's end and of its rail seat from its centre [m].
    sleeper_bending_stiffness, sleeper_shear_stiffness : float
        Sleeper EI [N m2] and kGA [N].
    sleeper_mass_per_length, sleeper_rotary_inertia_per_length : float
        Sleeper m [kg/m] and m r2 [kg m].
    sleeper_elements : int
        Beam elements in half a sleeper.
    ballast : str
        ``state_dependent``: Eq. (27) and (30) on top of the linear ballast; ``linear``: without;
        ``hyperbolic``: Eq. (26); or a CSV file with displacement [m], load [N].
    ballast_alpha, ballast_beta, ballast_delta : float
        Coefficients of Eq. (27) [N/m2], [N/m3], [N/m4].
    ballast_slope : float
        Rise of the secant stiffness of hyperbolic ballast with its load [1/m].
    ballast_tangent_damping, ballast_pulls : bool
        Whether damping follows the tangent stiffness, not the secant; whether a lifted sleeper is
        pulled back.
    pad : str
        ``linear`` or a CSV file: displacement [m], load [N]; or preload [N], static stiffness,
        stiffness [N/m] and damping [N s/m] of the branch.
    clip_preload : float
        Preload of a pad under the unloaded rail [N], where its parameters depend on it.
    supports : str
        CSV file with what supports have of their own.
    supports_repeat : bool
        Whether that begins anew behind the last support of the file.
    mode_pairs : int, optional
        Retained pairs of complex modes; see `retained_pairs`.
    residual_flexibility : bool
        Whether the static part of the other modes is kept, Eq. (13).
    supports_per_wheel : int
        Number of nearest supports with state-dependent forces.
    endless : bool
        Whether the track goes on without end, its bays being those around the wheels at any time.
    """

    bays: Annotated[int, Number(unit="bays", at_least=2, at_most=10_000)] = 50
    elements_per_bay: Annotated[int, Number(unit="elements", at_least=1, at_most=100)] = 8
    bending_stiffness: Annotated[float, Number(unit="N m2", above=0.0)] = 6.4e6
    shear_stiffness: Annotated[float, Number(unit="N", above=0.0)] = 250e6
    mass_per_length: Annotated[float, Number(unit="kg/m", above=0.0)] = 60.0
    rotary_inertia_per_length: Annotated[float, Number(unit="kg m", at_least=0.0)] = 0.24
    pad_stiffness: Annotated[float, Number(unit="N/m", above=0.0)] = 80e6
    pad_damping: Annotated[float, Number(unit="N s/m", at_least=0.0)] = 15e3
    sleeper_mass: Annotated[float, Number(unit="kg", above=0.0)] = 125.0
    sleeper_spacing: Annotated[float, Number(unit="m", above=0.0)] = 0.65
    ballast_stiffness: Annotated[float, Number(unit="N/m", above=0.0)] = 30e6
    ballast_damping: Annotated[float, Number(unit="N s/m", at_least=0.0)] = 31e3
    sleeper: Annotated[str, Choice(("rigid", "beam"))] = "rigid"
    sleeper_half_length: Annotated[float, Number(unit="m", above=0.0)] = 1.25
    sleeper_rail_seat: Annotated[float, Number(unit="m", above=0.0)] = 0.75
    sleeper_bending_stiffness: Annotated[float, Number(unit="N m2", above=0.0)] = 5.5e6
    sleeper_shear_stiffness: Annotated[float, Number(unit="N", above=0.0)] = 565e6
    sleeper_mass_per_length: Annotated[float, Number(unit="kg/m", above=0.0)] = 100.0
    sleeper_rotary_inertia_per_length: Annotated[float, Number(unit="kg m", at_least=0.0)] = 0.33
    sleeper_elements: Annotated[int, Number(unit="elements", at_least=2, at_most=100)] = 8
    ballast: Annotated[str, Choice(("state_dependent", "linear", "hyperbolic"), or_csv=True)] = (
        "state_dependent"
    )
    ballast_alpha: Annotated[float, Number(unit="N/m2")] = 0.37e12
    ballast_beta: Annotated[float, Number(unit="N/m3")] = -2.47e15
    ballast_delta: Annotated[float, Number(unit="N/m4")] = 5.75e18
    ballast_slope: Annotated[float, Number(unit="1/m", above=0.0)] = 2e3
    ballast_tangent_damping: bool = False
    ballast_pulls: bool = True
    pad: Annotated[str, Choice(("linear",), or_csv=True)] = "linear"
    clip_preload: Annotated[float, Number(unit="N", at_least=0.0)] = 20e3
    supports: Annotated[str, CsvFile()] = ""
    supports_repeat: bool = False
    mode_pairs: Annotated[int | None, Number(unit="pairs", at_least=1)] = None
    residual_flexibility: bool = True
    supports_per_wheel: Annotated[int, Number(unit="supports", at_least=1)] = 6
    endless: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "track")
        if self.sleeper_rail_seat >= self.sleeper_half_length:
            raise InputError(
                f"track.sleeper_rail_seat is {self.sleeper_rail_seat:g} m but must be less than "
                f"track.sleeper_half_length, {self.sleeper_half_length:g} m, where the sleeper "
                "ends: move the rail seat inwards"
            )
        if self.supports_repeat and not self.supports:
            raise InputError(
                "track.supports_repeat is true but track.supports names no file that could be "
                "repeated: name one or leave the key out"
            )
        if self.degrees_of_freedom > MOST_DEGREES_OF_FREEDOM:
            raise InputError(
                f"track.bays = {self.bays} with track.elements_per_bay = {self.elements_per_bay} "
                f"make {self.degrees_of_freedom} degrees of freedom, but at most "
                f"{MOST_DEGREES_OF_FREEDOM} can be solved: use fewer of either"
            )
        if self.mode_pairs is not None and self.mode_pairs > self.degrees_of_freedom:
            raise InputError(
                f"track.mode_pairs is {self.mode_pairs} but a track of {self.bays} bays with "
                f"{self.elements_per_bay} elements each has only {self.degrees_of_freedom} mode "
                "pairs: ask for fewer or refine the track"
            )

    @property
    def length(self) -> float:
        """Length between the clamped ends [m]."""
        return self.bays * self.sleeper_spacing

    @property
    def retained_pairs(self) -> int:
        """Retained pairs of complex modes, up to 2.7 kHz without a number: three per bay.

        Seven per bay where sleepers bend, each of which has four modes of its own down there.
        """
        per_bay = 3 if self.sleeper == "rigid" else 7
        return self.mode_pairs or min(per_bay * self.bays, self.degrees_of_freedom)

    @property
    def degrees_of_freedom(self) -> int:
        """Two per inner rail node; one per rigid sleeper, more per sleeper that bends."""
        per_sleeper = 1 if self.sleeper == "rigid" else 2 * self.sleeper_elements + 1
        return 2 * (self.bays * self.elements_per_bay - 1) + per_sleeper * (self.bays - 1)
