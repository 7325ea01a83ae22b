"""What wheels are uneven by: the tables ``[[wheel_defect]]`` of a scenario, one class a kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

from .errors import InputError
from .field_rules import Choice, CsvFile, Number
from .fields import check_fields
from .irregularity.wheel_defects import amplitude_of

SECTION = "wheel_defect"


@dataclass(frozen=True, slots=True, kw_only=True)
class OnWheel:
    """Key of every defect.

    Attributes
    ----------
    wheel : int
        The wheel that has it, 1 leads.
    """

    wheel: Annotated[int, Number(at_least=1)] = 1

    def __post_init__(self) -> None:
        check_fields(self, SECTION)


@dataclass(frozen=True, slots=True, kw_only=True)
class WheelFlat(OnWheel):
    """Kind ``flat``: one more flat, which strikes at every turn.

    Attributes
    ----------
    angle_deg : float
        Angle of its centre [deg]; the angle zero of every wheel meets the rail at
        ``flat.position``, greater ones follow.
    length, depth : float
        Along the tread, and its largest drop [m]; a chord's depth follows from its length.
    shape : str
        ``haversine``, ``parabola``, ``cusp`` or ``chord``.
    rolled : bool
        Whether the round rail is rolled over the profile, or the profile is used as it is.
    """

    kind: ClassVar[str] = "flat"
    angle_deg: Annotated[float, Number(unit="deg")] = 0.0
    length: Annotated[float, Number(unit="m", above=0.0)] = 0.1
    depth: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.02)] = 0.9e-3
    shape: Annotated[str, Choice(("haversine", "parabola", "cusp", "chord"))] = "haversine"
    rolled: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Spall(WheelFlat):
    """Kind ``spall``: a flat that is short and deep, over which the wheel rolls."""

    kind: ClassVar[str] = "spall"
    length: Annotated[float, Number(unit="m", above=0.0)] = 0.03
    depth: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.02)] = 1e-3
    shape: Annotated[str, Choice(("haversine", "parabola", "cusp", "chord"))] = "parabola"
    rolled: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Polygon(OnWheel):
    """Kind ``polygon``: one order of a polygonal wheel.

    Attributes
    ----------
    order : int
        Waves around the wheel.
    amplitude : float, optional
        Of the cosine [m].
    level_db : float, optional
        Of its r.m.s. re 1 um [dB], instead of the amplitude.
    phase_deg : float
        Phase of the cosine at the angle zero [deg].
    """

    kind: ClassVar[str] = "polygon"
    order: Annotated[int, Number(at_least=1, at_most=500)]
    amplitude: Annotated[float | None, Number(unit="m", at_least=0.0, at_most=0.02)] = None
    level_db: Annotated[float | None, Number(unit="dB", at_least=-60.0, at_most=80.0)] = None
    phase_deg: Annotated[float, Number(unit="deg")] = 0.0

    def __post_init__(self) -> None:
        OnWheel.__post_init__(self)
        if (self.amplitude is None) == (self.level_db is None):
            known = "neither is" if self.amplitude is None else "both are"
            raise InputError(
                f"a polygon has either {SECTION}.amplitude or {SECTION}.level_db, but {known} "
                "given: give one of them"
            )

    @property
    def wave_amplitude(self) -> float:
        """Amplitude of the cosine [m]."""
        return amplitude_of(self.level_db) if self.level_db is not None else self.amplitude or 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredWheel(OnWheel):
    """Kind ``csv``: a measured tread.

    Attributes
    ----------
    file : str
        CSV file with the columns angle [rad], from 0 to below 2 pi, and drop [m], positive where
        metal is missing.
    scale : float
        Factor of the drops.
    """

    kind: ClassVar[str] = "csv"
    file: Annotated[str, CsvFile()]
    scale: Annotated[float, Number()] = 1.0

    def __post_init__(self) -> None:
        OnWheel.__post_init__(self)
        if not self.file:
            raise InputError(f"{SECTION}.file is '' but must be the path of a .csv file")


WheelSection: TypeAlias = WheelFlat | Spall | Polygon | MeasuredWheel
"""One of the defects that are added up."""

KINDS: Mapping[str, type[WheelSection]] = {
    kind.kind: kind for kind in (WheelFlat, Spall, Polygon, MeasuredWheel)
}
"""Their classes by the key ``kind``."""
