"""A passage as the user describes it, checked as a whole."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from fmu_src.python.support_table import LARGEST_NUMBER
from track_fmu.window import FARTHEST

from .errors import InputError
from .keep_section import Keep
from .master_section import Master
from .rail_sections import RailSection
from .sections import Flat, Run, Surface
from .signals import signals_of
from .suspension_section import Suspension, check_bodies
from .track_section import Track
from .variation import Variation
from .vehicle_section import DEFAULT_SPEED_KMH, Vehicle
from .wheel_sections import WheelSection

BEHIND_MIDSPAN = 0.025
"""How far behind the middle of its bay the flat's centre meets the rail by default [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """One passage: a track, a vehicle, a flat, the distance rolled and the master's settings.

    Positions are along the rail from its clamped start [m]; wheel 1 leads.

    Attributes
    ----------
    track, variation, vehicle, suspension, flat, surface, run, keep, master
        The sections of the scenario file.
    irregularity : tuple
        What the rail is uneven by; added up.
    wheel_defect : tuple
        What wheels are uneven by besides the flat; added up for every wheel.

    Raises
    ------
    InputError
        Where the sections do not fit together.
    """

    track: Track = field(default_factory=Track)
    variation: Variation = field(default_factory=Variation)
    vehicle: Vehicle = field(default_factory=Vehicle)
    suspension: Suspension = field(default_factory=Suspension)
    flat: Flat = field(default_factory=Flat)
    irregularity: tuple[RailSection, ...] = ()
    wheel_defect: tuple[WheelSection, ...] = ()
    surface: Surface = field(default_factory=Surface)
    run: Run = field(default_factory=Run)
    keep: Keep = field(default_factory=Keep)
    master: Master = field(default_factory=Master)

    def __post_init__(self) -> None:
        if not self.track.endless:
            self.variation.check_supports(self.track.bays - 1)
        check_bodies(self.vehicle, self.suspension)
        self._check_flat()
        self._check_uneven_surfaces()
        self._check_keep()
        self._check_start_of_track()
        self._check_end_of_track()

    @property
    def flat_position(self) -> float:
        """Rail position where the flat's centre meets the rail [m]."""
        if self.flat.position is not None:
            return self.flat.position
        midspan = (self.track.bays // 2 + 0.5) * self.track.sleeper_spacing
        return round(midspan + BEHIND_MIDSPAN, 9)  # 16.6, not 16.599999999999998

    @property
    def start_position(self) -> float:
        """Position of the leading wheel at t = 0 [m]."""
        ahead = self.vehicle.offsets[self.flat.wheel - 1]
        return self.flat_position - self.run.approach + ahead

    @property
    def distance(self) -> float:
        """Distance that every wheel rolls [m]."""
        return self.run.approach + self.run.departure

    @property
    def supports(self) -> int:
        """Number of supports from the first one on that the track has or the passage reaches.

        Where all those of an endless track are nominal, as many as its window has.
        """
        track = self.track
        if not (track.endless and (track.supports or self.variation.is_any)):
            return track.bays - 1
        return min(self._supports_reached, LARGEST_NUMBER)

    @property
    def _supports_reached(self) -> int:
        end = max(self.start_position, 0.0) + self.distance
        return (
            math.ceil(end / self.track.sleeper_spacing) + self.track.bays
        )  # the window's are less

    @property
    def struck_bay(self) -> int:
        """Bay that holds the flat's position, counted from 1."""
        bay = math.floor(self.flat_position / self.track.sleeper_spacing) + 1
        if self.track.endless:
            return bay
        return min(bay, self.track.bays)  # not one more where the quotient is rounded up

    @property
    def first_bay(self) -> int:
        """Bays before those whose sleepers the result shows: the ones around an endless flat."""
        return self.struck_bay - (self.track.bays // 2 + 1) if self.track.endless else 0

    @property
    def gauge_positions(self) -> tuple[float, float, float]:
        """Gauge positions [m]: middle of the struck bay, above the sleepers before and after it."""
        spacing, bay = self.track.sleeper_spacing, self.struck_bay
        return (bay - 0.5) * spacing, (bay - 1) * spacing, bay * spacing

    def resolved(self) -> Scenario:
        """Return the same passage with every value that is worked out written into its key."""
        vehicle, master = self.vehicle, self.master
        if not vehicle.speed_table:
            vehicle = replace(vehicle, speed_kmh=vehicle.speed_kmh or DEFAULT_SPEED_KMH)
        master = replace(master, algorithm=master.algorithm or "newton")
        if master.step is None:
            master = replace(master, max_step=master.largest_step)
        flat = replace(self.flat, position=self.flat_position)
        track = replace(self.track, mode_pairs=self.track.retained_pairs)
        return replace(self, track=track, vehicle=vehicle, flat=flat, master=master)

    def _check_flat(self) -> None:
        """Refuse a flat that its wheel or its track cannot hold."""
        flat, vehicle, track = self.flat, self.vehicle, self.track
        if flat.wheel > vehicle.wheels:
            raise InputError(
                f"flat.wheel is {flat.wheel} but the vehicle has {vehicle.wheels} wheels: choose "
                "one of them or raise vehicle.wheels"
            )
        if not (track.endless or 0.0 <= self.flat_position <= track.length):
            raise InputError(
                f"flat.position is {self.flat_position:g} m but the track reaches from 0 m to "
                f"{track.length:g} m: put the flat on the track or raise track.bays"
            )
        has_length = flat.shape != "none" and not flat.is_measured
        if has_length and flat.length > track.length:
            raise InputError(
                f"flat.length is {flat.length:g} m but must be at most {track.length:g} m, the "
                "length of the track: shorten the flat"
            )

    def _check_uneven_surfaces(self) -> None:
        """Refuse defects of wheels that there are not, and a rail that is given twice."""
        for item in self.wheel_defect:
            if item.wheel > self.vehicle.wheels:
                raise InputError(
                    f"wheel_defect.wheel is {item.wheel} but the vehicle has "
                    f"{self.vehicle.wheels} wheels: choose one of them or raise vehicle.wheels"
                )
        if self.irregularity and self.vehicle.rail_irregularity:
            raise InputError(
                "vehicle.rail_irregularity and tables [[irregularity]] are both given: name the "
                "file in a table of the kind csv"
            )

    def _check_keep(self) -> None:
        """Refuse to keep what the passage does not have."""
        there = [signal.name for signal in signals_of(self)]
        for name in self.keep.signals:
            if name not in there:
                raise InputError(
                    f"keep.signals has {name} but a passage of this vehicle on this track has only "
                    f"{', '.join(there)}: leave it out"
                )

    @property
    def is_smooth(self) -> bool:
        """Whether rail and wheels have nothing but the flat."""
        return not (self.irregularity or self.wheel_defect or self.vehicle.rail_irregularity)

    def _check_start_of_track(self) -> None:
        """Refuse a run that starts with a wheel before 0 m, where the track begins."""
        wheel = self.vehicle.wheels
        start = self.start_position - self.vehicle.offsets[-1]
        if start >= 0.0:
            return
        approach = _rounded_down(self.run.approach + start)
        remedy = f"shorten run.approach to at most {approach:g} m or " if approach > 0.0 else ""
        position = -_rounded_down(start - self.flat_position)
        remedy += (
            f"move flat.position to at least {position:g} m"
            if self.track.endless or position < self.track.length
            else "raise track.bays"
        )
        raise InputError(
            f"wheel {wheel} would start at {start:g} m but the track begins at 0 m: {remedy}"
        )

    def _check_end_of_track(self) -> None:
        """Refuse a run that leads a wheel beyond the track, or beyond what is known of it."""
        end = self.start_position + self.distance
        if self.track.endless:
            self._check_reach(end)
            return
        beyond = end - self.track.length
        if beyond <= 0.0:
            return
        departure = _rounded_down(self.run.departure - beyond)
        remedy = f"shorten run.departure to at most {departure:g} m, " if departure > 0.0 else ""
        position = _rounded_down(self.flat_position - beyond)
        if position > 0.0:
            remedy += f"move flat.position to at most {position:g} m "
        raise InputError(
            f"wheel 1 would end at {end:g} m but the track ends at {self.track.length:g} m: "
            f"{remedy}{'or ' if remedy else ''}raise track.bays, or set track.endless"
        )

    def _check_reach(self, end: float) -> None:
        """Refuse positions on an endless track that lose their digits, or too many supports."""
        if end > FARTHEST:
            raise InputError(
                f"wheel 1 would end at {end:g} m but positions may be at most {FARTHEST:g} m: "
                "shorten run.departure or put flat.position nearer to 0 m"
            )
        if self.variation.is_any and self._supports_reached > LARGEST_NUMBER:
            raise InputError(
                f"[variation] would describe {self._supports_reached} supports from 0 m to the end "
                f"of the run at {end:g} m, but at most {LARGEST_NUMBER} can be described: put "
                "flat.position nearer to 0 m, or name a track.supports with track.supports_repeat"
            )


def _rounded_down(length: float) -> float:
    """Round down to a millimetre, so that following a remedy satisfies the limit."""
    return math.floor(1000.0 * length + 1e-6) / 1000.0
