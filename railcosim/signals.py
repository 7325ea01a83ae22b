"""The time series of a result: where each comes from and what it means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from .scenario import Scenario

Dimension: TypeAlias = Literal["wheel", "sleeper", "gauge", "bogie", "car"]

ContactSide: TypeAlias = Literal["vehicle", "track"]
"""Which of the two FMUs has the contacts."""

COMPRESSION = "positive in compression"
DOWN = "positive downwards"
FORWARDS = "positive in the direction of travel"
BODIES: tuple[tuple[Literal["bogie", "car"], str], ...] = (
    ("bogie", "bogie frame"),
    ("car", "car body"),
)
SAGGING = "positive sagging: tension in the rail foot"


def labels(units: str, long_name: str, sign: str = "none") -> dict[str, str]:
    """Return the attributes of a variable in a result.

    Parameters
    ----------
    units : str
        As the CF conventions write them.
    long_name : str
        What it is.
    sign : str
        What is positive; ``none`` where nothing can be negative.
    """
    return {"units": units, "long_name": long_name, "sign": sign}


@dataclass(frozen=True, slots=True, kw_only=True)
class Signal:
    """One output of an FMU over all wheels, sleepers, gauges or bogies.

    Attributes
    ----------
    name : str
        Name in the result.
    source : str
        ``component.variable`` in the co-simulation, with ``[k]`` where the index belongs; the
        component ``contact`` is the one that has the contacts.
    dim : {"wheel", "sleeper", "gauge", "bogie", "car"}
        What k counts; there is one car body.
    units, long_name, sign : str
        Attributes in the result; units as the CF conventions write them.
    """

    name: str
    source: str
    dim: Dimension
    units: str
    long_name: str
    sign: str

    def path(self, k: int, contact: ContactSide = "vehicle") -> str:
        """Name the output of the k-th wheel, sleeper, gauge or bogie, counted from 1."""
        component, _, variable = self.source.replace("[k]", f"[{k}]").partition(".")
        return f"{contact if component == 'contact' else component}.{variable}"

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the series in the result."""
        return labels(self.units, self.long_name, self.sign)


SIGNALS = (
    Signal(
        name="contact_force",
        source="contact.wheel[k].contact_force",
        dim="wheel",
        units="N",
        long_name="wheel-rail contact force",
        sign=COMPRESSION,
    ),
    Signal(
        name="gap",
        source="contact.wheel[k].gap",
        dim="wheel",
        units="m",
        long_name="gap between wheel and rail, minus the compression",
        sign="positive apart",
    ),
    Signal(
        name="in_contact",
        source="contact.wheel[k].in_contact",
        dim="wheel",
        units="1",
        long_name="whether the wheel touches the rail",
        sign="true in contact",
    ),
    Signal(
        name="wheel_position",
        source="vehicle.wheel[k].position",
        dim="wheel",
        units="m",
        long_name="position of the wheel along the rail",
        sign=FORWARDS,
    ),
    Signal(
        name="wheel_displacement",
        source="vehicle.wheel[k].displacement",
        dim="wheel",
        units="m",
        long_name="displacement of the wheel",
        sign=DOWN,
    ),
    Signal(
        name="wheel_velocity",
        source="vehicle.wheel[k].velocity",
        dim="wheel",
        units="m s-1",
        long_name="velocity of the wheel",
        sign=DOWN,
    ),
    Signal(
        name="rail_displacement",
        source="track.wheel[k].rail_displacement",
        dim="wheel",
        units="m",
        long_name="displacement of the rail under the wheel",
        sign=DOWN,
    ),
    Signal(
        name="rail_velocity",
        source="track.wheel[k].rail_velocity",
        dim="wheel",
        units="m s-1",
        long_name="velocity of the rail under the wheel, following the wheel",
        sign=DOWN,
    ),
    Signal(
        name="bending_moment_under_wheel",
        source="track.wheel[k].bending_moment",
        dim="wheel",
        units="N m",
        long_name="bending moment of the rail under the wheel",
        sign=SAGGING,
    ),
    Signal(
        name="sleeper_displacement",
        source="track.sleeper[k].displacement",
        dim="sleeper",
        units="m",
        long_name="displacement of the sleeper",
        sign=DOWN,
    ),
    Signal(
        name="pad_force",
        source="track.pad[k].force",
        dim="sleeper",
        units="N",
        long_name="force in the rail pad",
        sign=COMPRESSION,
    ),
    Signal(
        name="ballast_force",
        source="track.ballast[k].force",
        dim="sleeper",
        units="N",
        long_name="force in ballast and subgrade beyond that at rest",
        sign=COMPRESSION,
    ),
    Signal(
        name="bending_moment",
        source="track.gauge[k].bending_moment",
        dim="gauge",
        units="N m",
        long_name="bending moment of the rail at the gauge",
        sign=SAGGING,
    ),
)
"""Every time series that any result holds."""

REST = "positive downwards, from static equilibrium"

BODY_SIGNALS = (
    *(
        Signal(
            name=f"{body}_{name}",
            source=f"vehicle.{body}{'[k]' if body == 'bogie' else ''}.{name}",
            dim=body,
            units=units,
            long_name=f"{name} of the {what}",
            sign=sign,
        )
        for body, what in BODIES
        for name, units, sign in (
            ("displacement", "m", REST),
            ("pitch", "rad", "positive nose down, from static equilibrium"),
            ("acceleration", "m s-2", DOWN),
        )
    ),
    Signal(
        name="primary_force",
        source="vehicle.primary[k].force",
        dim="wheel",
        units="N",
        long_name="force in the primary suspension of the wheel",
        sign=COMPRESSION,
    ),
    Signal(
        name="secondary_force",
        source="vehicle.secondary[k].force",
        dim="bogie",
        units="N",
        long_name="force in the secondary suspension of the bogie",
        sign=COMPRESSION,
    ),
)
"""The time series that the result of a suspended vehicle holds besides."""


SLEEPER_SIGNALS = (
    Signal(
        name="sleeper_bending_moment",
        source="track.sleeper[k].bending_moment",
        dim="sleeper",
        units="N m",
        long_name="bending moment of the sleeper at its rail seat",
        sign="positive sagging: tension in the sleeper's foot",
    ),
    Signal(
        name="sleeper_centre_bending_moment",
        source="track.sleeper[k].centre_bending_moment",
        dim="sleeper",
        units="N m",
        long_name="bending moment of the sleeper at its centre",
        sign="positive sagging: tension in the sleeper's foot",
    ),
)
"""What a result holds besides where sleepers are beams."""


def signals_of(scenario: Scenario) -> tuple[Signal, ...]:
    """Return the time series that the result of a scenario holds."""
    bodies = BODY_SIGNALS if scenario.vehicle.is_suspended else ()
    sleepers = () if scenario.track.sleeper == "rigid" else SLEEPER_SIGNALS
    return (*SIGNALS, *bodies, *sleepers)
