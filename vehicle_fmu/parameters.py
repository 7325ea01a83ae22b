"""Parameters of the vehicle and of a wheel flat, with the demonstration example as default."""

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from .validation import check_offsets, require_finite, require_positive

FlatShape: TypeAlias = Literal["none", "haversine", "parabola", "cusp", "chord", "table"]


@dataclass(frozen=True, slots=True, kw_only=True)
class VehicleParameters:
    """A row of equal wheels; defaults of Nielsen & Oscarsson (2004), Table 1.

    Attributes
    ----------
    offsets : tuple of float
        How far each wheel runs behind wheel 1 [m], wheel 1 included, which has 0.
    wheel_mass : float
        Mass moving with each wheel, half the unsprung mass of a wheelset [kg].
    static_wheel_load : float
        Total static wheel-rail force, the only weight in the model [N].
    wheel_radius : float
        Rolling radius [m].
    hertz_coefficient : float
        Coefficient C_H of the contact law F = C_H delta^1.5 [N/m^1.5].
    initial_position : float
        Position of wheel 1 along the rail at the start [m].
    substep : float
        Longest internal integration step [s]. With 2e-5 the contact force under a 100 mm flat is
        off by less than 0.1 % of the static load, up to 100 km/h.

    Raises
    ------
    ValueError
        If a value is not finite or outside its range.
    """

    offsets: tuple[float, ...] = (0.0, 1.8)
    wheel_mass: float = 592.5
    static_wheel_load: float = 117_720.0
    wheel_radius: float = 0.45
    hertz_coefficient: float = 9.17e10
    initial_position: float = 12.7
    substep: float = 2e-5

    def __post_init__(self) -> None:
        check_offsets(self.offsets)
        for name, unit, remedy in (
            ("wheel_mass", "kg", "give half the unsprung mass of a wheelset"),
            ("static_wheel_load", "N", "give half the axle load as a force"),
            ("wheel_radius", "m", "give half the wheel diameter"),
            ("hertz_coefficient", "N/m^1.5", "about 9e10 for steel wheel and rail"),
            ("substep", "s", "2e-5 resolves the contact"),
        ):
            require_positive(name, getattr(self, name), unit, remedy)
        require_finite("initial_position", self.initial_position, "m", "give the start of wheel 1")

    @property
    def wheels(self) -> int:
        """Number of wheels on the rail."""
        return len(self.offsets)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatParameters:
    """A flat on one wheel.

    Attributes
    ----------
    shape : {"none", "haversine", "parabola", "cusp", "chord", "table"}
        Drop of the tread over the distance from the flat's centre; see `wheel_profile`.
    length : float
        Length of the flat along the tread [m]. Not used by "none" and "table".
    depth : float
        Largest drop [m]. Not used by "none", "table" and "chord": a chord's depth follows
        from its length and the wheel radius, length^2 / (8 R).
    wheel : int
        The wheel that has the flat, counted from 1.
    position : float
        Position along the rail where the flat's centre meets it [m].
    periodic : bool
        The flat strikes once every turn of the wheel, before and after `position`; else once.
    rolled : bool
        The drop is that of the wheel centre rolling over the flat; else that of the tread.

    Raises
    ------
    ValueError
        If the shape is unknown or a value is not finite or outside its range.
    """

    shape: FlatShape = "haversine"
    length: float = 0.1
    depth: float = 0.9e-3
    wheel: int = 1
    position: float = 16.6
    periodic: bool = False
    rolled: bool = False

    def __post_init__(self) -> None:
        if self.shape not in get_args(FlatShape):
            allowed = ", ".join(get_args(FlatShape))
            raise ValueError(f"flat shape is {self.shape!r}; it must be one of {allowed}")
        require_positive("flat length", self.length, "m", "shape 'none' is a round wheel")
        require_finite("flat depth", self.depth, "m", "shape 'none' is a round wheel")
        if self.depth < 0.0:
            raise ValueError(
                f"flat depth is {self.depth:g} m; it is the missing material and must not be "
                "negative: give it as a positive number"
            )
        if self.wheel < 1:
            raise ValueError(f"flat wheel is {self.wheel}; wheels are counted from 1")
        require_finite("flat position", self.position, "m", "give where its centre meets the rail")
