"""Parameters of the linear track, with the values of Table 1 of Nielsen & Oscarsson (2004)."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from .beam_element import BeamSection

GRAVITY = 9.81
"""Acceleration of free fall [m/s2]."""

SLEEPERS = ("rigid", "beam")
"""What a sleeper may be."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackParameters:
    """Half a ballasted track: one rail on discrete supports, clamped at both ends.

    Every support is a rail pad on a (half) sleeper on ballast; supports stand at the inner bay
    boundaries, so a track of ``bays`` bays has ``bays - 1`` of them. The defaults of a sleeper that
    bends are those of a monobloc concrete sleeper of the same mass as Table 1's: `docs/sleepers.md`
    says where they come from.

    Parameters
    ----------
    bays : int
        Number of sleeper bays, at least 2.
    elements_per_bay : int
        Beam elements in a bay, at least 1.
    sleeper_spacing : float
        Length of a bay [m].
    bending_stiffness, shear_stiffness : float
        ``EI`` [N m2] and ``kAG`` [N] of the rail.
    mass_per_length, rotary_inertia_per_length : float
        Of the rail [kg/m], [kg m].
    pad_stiffness, pad_damping : float
        Linear rail pad [N/m], [N s/m].
    sleeper_mass : float
        Half a rigid sleeper [kg].
    ballast_stiffness, ballast_damping : float
        Linear ballast and subgrade under one rail seat, unloaded track [N/m], [N s/m].
    sleeper : {"rigid", "beam"}
        Whether sleepers are masses or Rayleigh-Timoshenko beams on evenly spread ballast; what
        follows is for beams only.
    sleeper_half_length, sleeper_rail_seat : float
        Distance of a sleeper's end and of its rail seat from its centre [m].
    sleeper_bending_stiffness, sleeper_shear_stiffness : float
        ``EI`` [N m2] and ``kAG`` [N] of a sleeper.
    sleeper_mass_per_length, sleeper_rotary_inertia_per_length : float
        Of a sleeper [kg/m], [kg m].
    sleeper_elements : int
        Beam elements in half a sleeper, at least 2.

    Raises
    ------
    ValueError
        If a value is not finite or outside its range.
    """

    bays: int = 50
    elements_per_bay: int = 8
    sleeper_spacing: float = 0.65
    bending_stiffness: float = 6.4e6
    shear_stiffness: float = 250e6
    mass_per_length: float = 60.0
    rotary_inertia_per_length: float = 0.24
    pad_stiffness: float = 80e6
    pad_damping: float = 15e3
    sleeper_mass: float = 125.0
    ballast_stiffness: float = 30e6
    ballast_damping: float = 31e3
    sleeper: str = "rigid"
    sleeper_half_length: float = 1.25
    sleeper_rail_seat: float = 0.75
    sleeper_bending_stiffness: float = 5.5e6
    sleeper_shear_stiffness: float = 565e6
    sleeper_mass_per_length: float = 100.0
    sleeper_rotary_inertia_per_length: float = 0.33
    sleeper_elements: int = 8

    def __post_init__(self) -> None:
        if self.sleeper not in SLEEPERS:
            raise ValueError(f"track: sleeper is {self.sleeper!r}; it must be 'rigid' or 'beam'")
        for name, least in (("bays", 2), ("elements_per_bay", 1), ("sleeper_elements", 2)):
            value = getattr(self, name)
            if value != int(value) or value < least:
                raise ValueError(
                    f"track: {name} = {value!r} must be a whole number of at least {least}"
                )
        may_be_zero = {
            "rotary_inertia_per_length",
            "sleeper_rotary_inertia_per_length",
            "pad_damping",
            "ballast_damping",
        }
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, str):
                continue
            if not math.isfinite(value):
                raise ValueError(f"track: {field.name} = {value!r} must be a finite number")
            if value < 0.0 or (value == 0.0 and field.name not in may_be_zero):
                limit = "at least 0" if field.name in may_be_zero else "greater than 0"
                raise ValueError(f"track: {field.name} = {value!r} must be {limit}")
        if self.sleeper_rail_seat >= self.sleeper_half_length:
            raise ValueError(
                f"track: sleeper_rail_seat = {self.sleeper_rail_seat!r} m must be less than "
                f"sleeper_half_length = {self.sleeper_half_length!r} m, where the sleeper ends"
            )

    @property
    def section(self) -> BeamSection:
        """The rail as a beam section."""
        return BeamSection(
            bending_stiffness=self.bending_stiffness,
            shear_stiffness=self.shear_stiffness,
            mass_per_length=self.mass_per_length,
            rotary_inertia_per_length=self.rotary_inertia_per_length,
        )

    @property
    def sleeper_section(self) -> BeamSection:
        """A sleeper as a beam section."""
        return BeamSection(
            bending_stiffness=self.sleeper_bending_stiffness,
            shear_stiffness=self.sleeper_shear_stiffness,
            mass_per_length=self.sleeper_mass_per_length,
            rotary_inertia_per_length=self.sleeper_rotary_inertia_per_length,
        )

    @property
    def length(self) -> float:
        """Length of the track [m]."""
        return self.bays * self.sleeper_spacing

    @property
    def element_length(self) -> float:
        """Length of a beam element [m]."""
        return self.sleeper_spacing / self.elements_per_bay

    @property
    def elements(self) -> int:
        """Number of beam elements."""
        return self.bays * self.elements_per_bay

    @property
    def supports(self) -> int:
        """Number of sleepers."""
        return self.bays - 1
