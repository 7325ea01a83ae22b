"""The section `[vehicle]` of a scenario file: every key with its unit, default and limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from vehicle_fmu.hertz_coefficient import hertz_coefficient
from vehicle_fmu.suspension_parameters import GRAVITY

from .errors import InputError
from .field_rules import Choice, CsvFile, Number
from .fields import check_fields
from .presets import PRESETS

DEFAULT_SPEED_KMH = 40.0
"""Speed of the demonstration example [km/h]."""

RAIL_RADIUS = 0.3
"""Transverse radius of the railhead of the demonstration example [m]."""


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
