"""The sections of a scenario file: every key with its unit, default and limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from vehicle_fmu.hertz_coefficient import hertz_coefficient
from vehicle_fmu.suspension_parameters import GRAVITY

from .errors import InputError
from .fields import Choice, CsvFile, Number, check_fields, is_csv
from .presets import PRESETS

MOST_DEGREES_OF_FREEDOM = 10_000
"""Size of track whose modes fit in a few gigabytes of memory."""

DEFAULT_SPEED_KMH = 40.0
"""Speed of the demonstration example [km/h]."""

RAIL_RADIUS = 0.3
"""Transverse radius of the railhead of the demonstration example [m]."""


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
        CSV file with what supports have of their own; see `support_table`.
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
        if self.endless and self.sleeper != "rigid":
            raise InputError(
                "track.endless is true but track.sleeper is 'beam': an endless track has rigid "
                "sleepers"
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Vehicle:
    """Keys of ``[vehicle]``: wheels, each half a wheelset under half an axle load.

    Attributes
    ----------
    model : str
        ``masses``: nothing but their load is above the wheels; ``suspended``: bogie frames and a
        car body, as ``[suspension]`` has them.
    preset : str, optional
        A vehicle of the literature, one of `presets.PRESETS`, in a scenario file or override: the
        keys that these do not give take its values.
    speed_kmh : float, optional
        Constant speed [km/h]; 40 where neither a speed nor a table is given.
    speed_table : str
        CSV file with the columns time [s] and speed [m/s], instead of ``speed_kmh``.
    wheels, bogies : int
        Number of wheels, and of bogies with equal shares of them.
    wheel_mass : float
        Half of a wheelset's mass [kg].
    axle_load_t : float
        Axle load [t]; half of its weight is the whole static force of a wheel on the rail.
    axle_base, bogie_distance : float
        Distance of neighbouring wheels of a bogie, and of the centres of neighbouring bogies [m].
    wheel_radius : float
        Wheel radius [m].
    hertz_coefficient : float
        Contact force per compression to the power 3/2 [N/m1.5]; that of the radii where
        ``rail_radius`` is given.
    rail_radius : float, optional
        Transverse radius of the railhead [m]; with it the Hertz coefficient follows from both
        radii and the material. The contact patch is that of 0.3 m without.
    youngs_modulus, poissons_ratio : float
        Material of wheel and rail [Pa], [1].
    rail_irregularity : str
        CSV file with the columns position [m] and drop [m] of the railhead, downwards positive;
        empty for a smooth rail.
    """

    speed_kmh: Annotated[float | None, Number(unit="km/h", at_least=0.1, at_most=1000.0)] = None
    speed_table: Annotated[str, CsvFile()] = ""
    model: Annotated[str, Choice(("masses", "suspended"))] = "masses"
    preset: Annotated[str | None, Choice(tuple(PRESETS))] = None
    wheels: Annotated[int, Number(unit="wheels", at_least=1, at_most=100)] = 2
    bogies: Annotated[int, Number(unit="bogies", at_least=1, at_most=100)] = 1
    wheel_mass: Annotated[float, Number(unit="kg", above=0.0)] = 592.5
    axle_load_t: Annotated[float, Number(unit="t", at_least=0.1, at_most=100.0)] = 24.0
    axle_base: Annotated[float, Number(unit="m", above=0.0)] = 1.8
    bogie_distance: Annotated[float, Number(unit="m", above=0.0)] = 19.0
    wheel_radius: Annotated[float, Number(unit="m", above=0.0)] = 0.45
    hertz_coefficient: Annotated[float, Number(unit="N/m1.5", above=0.0)] = 9.17e10
    rail_radius: Annotated[float | None, Number(unit="m", at_least=0.01, at_most=100.0)] = None
    youngs_modulus: Annotated[float, Number(unit="Pa", above=0.0)] = 206e9
    poissons_ratio: Annotated[float, Number(at_least=0.0, at_most=0.5)] = 0.3
    rail_irregularity: Annotated[str, CsvFile()] = ""

    def __post_init__(self) -> None:
        check_fields(self, "vehicle")
        if self.rail_radius is not None:
            self._take_coefficient(self.rail_radius)
        if self.speed_table and self.speed_kmh is not None:
            raise InputError(
                f"vehicle.speed_kmh = {self.speed_kmh:g} and vehicle.speed_table = "
                f"{self.speed_table!r} are both given: leave one of them out"
            )
        if self.wheels % self.bogies:
            raise InputError(
                f"vehicle.wheels is {self.wheels}, which {self.bogies} bogies cannot share: make "
                "it a multiple of vehicle.bogies"
            )

    @property
    def is_suspended(self) -> bool:
        """Whether there are bodies above the wheels."""
        return self.model == "suspended"

    @property
    def offsets(self) -> tuple[float, ...]:
        """How far each wheel runs behind the first [m]."""
        share = self.wheels // self.bogies
        return tuple(
            j * self.bogie_distance + i * self.axle_base
            for j in range(self.bogies)
            for i in range(share)
        )

    def _take_coefficient(self, rail_radius: float) -> None:
        """Work the Hertz coefficient out, unless another one is given."""
        try:
            coefficient = hertz_coefficient(
                wheel_radius=self.wheel_radius,
                rail_radius=rail_radius,
                youngs_modulus=self.youngs_modulus,
                poissons_ratio=self.poissons_ratio,
            )
        except ValueError as error:
            raise InputError(f"vehicle.rail_radius: {error}") from error
        default = type(self)().hertz_coefficient
        if self.hertz_coefficient not in {default, coefficient}:
            raise InputError(
                f"vehicle.hertz_coefficient is {self.hertz_coefficient:g} N/m1.5 but that of "
                f"vehicle.rail_radius = {rail_radius:g} is {coefficient:g} N/m1.5: leave one of "
                "them out"
            )
        object.__setattr__(self, "hertz_coefficient", coefficient)

    @property
    def static_wheel_load(self) -> float:
        """Static wheel-rail force of one wheel [N], compression positive."""
        return self.axle_load_t * 1000.0 * GRAVITY / 2.0

    @property
    def constant_speed(self) -> float:
        """Speed where no table is given [m/s]."""
        kmh = DEFAULT_SPEED_KMH if self.speed_kmh is None else self.speed_kmh
        return kmh / 3.6


@dataclass(frozen=True, slots=True, kw_only=True)
class Flat:
    """Keys of ``[flat]``: the wheel flat and the place where it meets the rail.

    Attributes
    ----------
    shape : str
        ``haversine``, ``parabola``, ``cusp``, ``chord``, ``none`` or a CSV file.
    length, depth : float
        Independent of each other [m]; a chord's depth follows from its length, and a CSV file
        brings both.
    wheel : int
        Wheel that has the flat, 1 leads.
    position : float, optional
        Rail position where the flat's centre meets the rail [m]; 25 mm behind the middle of bay
        ``bays // 2 + 1`` where none is given.
    periodic : bool
        Whether the flat strikes once per turn of the wheel, or once.
    rolled : bool
        Whether the round rail is rolled over the profile, or the profile is used as it is.
    """

    shape: Annotated[
        str, Choice(("haversine", "parabola", "cusp", "chord", "none"), or_csv=True)
    ] = "haversine"
    length: Annotated[float, Number(unit="m", above=0.0)] = 0.1
    depth: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.02)] = 0.9e-3
    wheel: Annotated[int, Number(at_least=1)] = 1
    position: Annotated[float | None, Number(unit="m")] = None
    periodic: bool = False
    rolled: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "flat")

    @property
    def is_measured(self) -> bool:
        """Whether the shape is a CSV file."""
        return is_csv(self.shape)


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """Keys of ``[run]``: how far the flat's wheel rolls.

    Attributes
    ----------
    approach, departure : float
        Distance rolled before and after the flat's centre meets the rail [m].
    """

    approach: Annotated[float, Number(unit="m", above=0.0)] = 3.9
    departure: Annotated[float, Number(unit="m", above=0.0)] = 2.6

    def __post_init__(self) -> None:
        check_fields(self, "run")


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """Keys of ``[surface]``: how the tables of irregularities and wheel defects are used.

    Attributes
    ----------
    ramp : float
        Distance over which the irregularities of the rail set in, from the start of the leading
        wheel [m].
    contact_filter : bool
        Whether waves are weakened that are not much longer than the contact patch; flats and
        spalls are left as they are.
    """

    ramp: Annotated[float, Number(unit="m", at_least=0.0)] = 1.0
    contact_filter: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "surface")
