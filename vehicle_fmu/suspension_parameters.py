"""Parameters of the suspended vehicle over one rail: half of everything that both rails carry."""

from dataclasses import dataclass

from .validation import require_finite, require_not_negative, require_positive

GRAVITY = 9.81
"""Gravitational acceleration that turns a mass into a weight [m/s2]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SuspensionElement:
    """A spring and damper with a bump stop, each with a kink at most.

    With e the compression from static equilibrium, its force beyond the static one is

        k e + k_s [max(0, e - c) - max(0, -c)] + d e',   d = damping (1 or rebound_ratio)

    so that it vanishes at rest even where the stop carries a part of the static load.

    Attributes
    ----------
    stiffness, damping : float
        k [N/m] and damping in compression [N s/m].
    rebound_ratio : float
        Damping in extension over that in compression.
    clearance : float
        c [m]: compression from static equilibrium at which the stop is met; negative where it is
        met in static equilibrium already, as by the second spring of a loaded wagon.
    stop_stiffness : float
        k_s [N/m], beside that of the spring; 0 is no stop.

    Raises
    ------
    ValueError
        If a value is not finite or, but for the clearance, negative.
    """

    stiffness: float
    damping: float = 0.0
    rebound_ratio: float = 1.0
    clearance: float = 0.0
    stop_stiffness: float = 0.0

    def __post_init__(self) -> None:
        for name, unit, remedy in (
            ("stiffness", "N/m", "0 is no spring"),
            ("damping", "N s/m", "0 is no damper"),
            ("rebound_ratio", "", "1 damps extension as much as compression"),
            ("stop_stiffness", "N/m", "0 is no bump stop"),
        ):
            require_not_negative(name, getattr(self, name), unit, remedy)
        require_finite("clearance", self.clearance, "m", "give the way to the bump stop")


PRIMARY = SuspensionElement(stiffness=1.22e6, damping=4e3)
"""Of a wheel; Iwnicki, Vehicle System Dynamics 30 (1998) 295-313, passenger coach."""

SECONDARY = SuspensionElement(stiffness=430e3, damping=20e3)
"""Of one side of a bogie; from the same coach."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tread:
    """The outer part of a flexible wheelset, borne by its hub through a spring and a damper.

    Attributes
    ----------
    mass : float
        What touches the rail, a part of the wheel's mass [kg].
    stiffness, damping : float
        Between tread and hub [N/m], [N s/m].

    Raises
    ------
    ValueError
        If a value is not finite or outside its range.
    """

    mass: float
    stiffness: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_positive("tread.mass", self.mass, "kg", "give a part of the wheel's mass")
        require_positive(
            "tread.stiffness", self.stiffness, "N/m", "a flexible wheelset needs its stiffness"
        )
        require_not_negative("tread.damping", self.damping, "N s/m", "0 is no damper")


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyParameters:
    """Bogie frames and car body; defaults from the coach of Iwnicki (1998).

    Attributes
    ----------
    bogie_mass, bogie_pitch_inertia : tuple of float
        Of one side of each bogie frame, wheels excluded [kg], [kg m2].
    car_mass : float
        Of this rail's side of the car body [kg]; 0: what the static wheel loads leave.
    car_pitch_inertia : float
        Of this rail's side of the car body [kg m2].
    primary, secondary : SuspensionElement
        Between each wheel and its bogie frame; between each frame's centre and the car body.

    Raises
    ------
    ValueError
        If there is no bogie, or a mass or inertia is not finite or outside its range.
    """

    bogie_mass: tuple[float, ...] = (1307.5,)
    bogie_pitch_inertia: tuple[float, ...] = (738.0,)
    car_mass: float = 0.0
    car_pitch_inertia: float = 985e3
    primary: SuspensionElement = PRIMARY
    secondary: SuspensionElement = SECONDARY

    def __post_init__(self) -> None:
        if not self.bogie_mass or len(self.bogie_mass) != len(self.bogie_pitch_inertia):
            raise ValueError(
                f"{len(self.bogie_mass)} bogie masses and {len(self.bogie_pitch_inertia)} pitch "
                "inertias are given; every bogie needs both, and there is at least one"
            )
        for j, (mass, inertia) in enumerate(
            zip(self.bogie_mass, self.bogie_pitch_inertia, strict=True), start=1
        ):
            require_positive(f"bogie[{j}].mass", mass, "kg", "give half a bogie frame's mass")
            require_positive(
                f"bogie[{j}].pitch_inertia", inertia, "kg m2", "give half a bogie frame's inertia"
            )
        require_not_negative(
            "car.mass", self.car_mass, "kg", "0 takes what the static wheel loads leave"
        )
        require_positive(
            "car.pitch_inertia", self.car_pitch_inertia, "kg m2", "give half a car body's inertia"
        )


def car_mass(bodies: BodyParameters, *, wheels: int, wheel_mass: float, load: float) -> float:
    """Return the mass of this rail's side of the car body [kg], as given or as the loads leave it.

    Parameters
    ----------
    bodies : BodyParameters
        The bodies above the wheels.
    wheels : int
        Number of wheels.
    wheel_mass, load : float
        Mass [kg] and static load [N] of each wheel.

    Raises
    ------
    ValueError
        If the masses weigh more than the static wheel loads.
    """
    below = wheels * wheel_mass + sum(bodies.bogie_mass)
    carried = wheels * load / GRAVITY
    left = carried - below
    if not (left > 0.0 and bodies.car_mass <= left * (1.0 + 1e-6)):
        raise ValueError(
            f"wheels, bogies and car body have {below + bodies.car_mass:g} kg over this rail, the "
            f"static wheel loads carry {carried:g} kg; raise static_wheel_load or give smaller "
            "masses"
        )
    return bodies.car_mass or left
