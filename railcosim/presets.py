"""Vehicles of the literature, as keys of a scenario."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

WHEELS, BOGIES = 4, 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """A four-axle vehicle on two bogies, whole as its source describes it.

    Attributes
    ----------
    source : str
        Where the figures come from.
    car_mass, car_pitch_inertia : float
        Car body [kg], [kg m2].
    bogie_mass, bogie_pitch_inertia : float
        A bogie frame [kg], [kg m2].
    wheelset_mass : float
        A wheelset with what else is unsprung [kg].
    primary, secondary : tuple of float
        Stiffness [N/m] and damping [N s/m] of one side of a wheelset, and of a bogie.
    axle_base, bogie_distance : float
        Between the axles of a bogie, and between the bogies' centres [m].
    """

    source: str
    car_mass: float
    car_pitch_inertia: float
    bogie_mass: float
    bogie_pitch_inertia: float
    wheelset_mass: float
    primary: tuple[float, float]
    secondary: tuple[float, float]
    axle_base: float
    bogie_distance: float

    @property
    def axle_load_t(self) -> float:
        """A quarter of the whole mass [t]."""
        mass = self.car_mass + BOGIES * self.bogie_mass + WHEELS * self.wheelset_mass
        return mass / WHEELS / 1000.0

    def keys(self) -> dict[str, dict[str, float | int | str]]:
        """Return the keys of a scenario by section: half the vehicle, over one rail."""
        return {
            "vehicle": {
                "model": "suspended",
                "wheels": WHEELS,
                "bogies": BOGIES,
                "wheel_mass": 0.5 * self.wheelset_mass,
                "axle_load_t": self.axle_load_t,
                "axle_base": self.axle_base,
                "bogie_distance": self.bogie_distance,
            },
            "suspension": {
                "primary_stiffness": self.primary[0],
                "primary_damping": self.primary[1],
                "secondary_stiffness": self.secondary[0],
                "secondary_damping": self.secondary[1],
                "bogie_mass": 0.5 * self.bogie_mass,
                "bogie_pitch_inertia": 0.5 * self.bogie_pitch_inertia,
                "car_pitch_inertia": 0.5 * self.car_pitch_inertia,
            },
        }


ZHAI = (
    "Zhai, Wang & Cai, Fundamentals of vehicle-track coupled dynamics, Vehicle System Dynamics 47 "
    "(2009) 1349-1376"
)

PRESETS: Mapping[str, Preset] = {
    "manchester_coach": Preset(
        source="Iwnicki, Manchester benchmarks for rail vehicle simulation, Vehicle System "
        "Dynamics 30 (1998) 295-313",
        car_mass=32_000.0,
        car_pitch_inertia=1.97e6,
        bogie_mass=2615.0,
        bogie_pitch_inertia=1476.0,
        wheelset_mass=1813.0,
        primary=(1.22e6, 4e3),
        secondary=(430e3, 20e3),
        axle_base=2.56,
        bogie_distance=19.0,
    ),
    "double_deck_coach": Preset(
        source=ZHAI,
        car_mass=29_600.0,
        car_pitch_inertia=2.139e6,
        bogie_mass=1700.0,
        bogie_pitch_inertia=1700.0,
        wheelset_mass=1900.0,
        primary=(0.873e6, 30e3),
        secondary=(0.41e6, 108.7e3),
        axle_base=2.4,
        bogie_distance=18.0,
    ),
    "star_power_car": Preset(
        source=ZHAI,
        car_mass=59_364.2,
        car_pitch_inertia=1.723e6,
        bogie_mass=5630.8,
        bogie_pitch_inertia=9487.0,
        wheelset_mass=1843.5,
        primary=(2.3996e6, 30e3),
        secondary=(0.8858e6, 45e3),
        axle_base=3.0,
        bogie_distance=11.46,
    ),
    "velaro_e_coach": Preset(
        source="Goicolea, Simplified mechanical description of AVE S-103 - ICE3 Velaro E high "
        "speed train, Universidad Politecnica de Madrid (2014)",
        car_mass=47_800.0,
        car_pitch_inertia=1_957_888.0,
        bogie_mass=3500.0,
        bogie_pitch_inertia=1715.0,
        wheelset_mass=1800.0,
        primary=(1.2e6, 10e3),
        secondary=(350e3, 20e3),
        axle_base=2.5,
        bogie_distance=17.375,
    ),
}
"""By the name that `vehicle.preset` takes."""
