"""What a rail is uneven by: the tables ``[[irregularity]]`` of a scenario, one class a kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

from .errors import InputError
from .field_rules import Choice, CsvFile, Number
from .fields import check_fields
from .irregularity.rail_defects import joint_depth

Metres: TypeAlias = Annotated[float, Number(unit="m", above=0.0)]
Position: TypeAlias = Annotated[float | None, Number(unit="m")]

SECTION = "irregularity"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stretch:
    """Keys of every irregularity that reaches over a stretch of the rail.

    Attributes
    ----------
    begin, end : float, optional
        Ends of the stretch [m]; all of the rail without.
    taper : float
        Length over which it sets in behind ``begin`` and ends before ``end`` [m].
    """

    begin: Position = None
    end: Position = None
    taper: Annotated[float, Number(unit="m", at_least=0.0)] = 0.5

    def __post_init__(self) -> None:
        check_fields(self, SECTION)
        if self.begin is not None and self.end is not None and self.end <= self.begin:
            raise InputError(
                f"{SECTION}.end is {self.end:g} m but must be above {SECTION}.begin, "
                f"{self.begin:g} m: exchange them"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomStretch(Stretch):
    """Keys of every random irregularity.

    Attributes
    ----------
    seed : int
        Of its phases; another one is another rail of the same spectrum.
    shortest_wavelength, longest_wavelength : float
        Wavelengths between which it has waves [m].
    """

    seed: Annotated[int, Number(at_least=0)] = 1
    shortest_wavelength: Metres = 1.0
    longest_wavelength: Metres = 100.0

    def __post_init__(self) -> None:
        Stretch.__post_init__(self)
        if self.shortest_wavelength >= self.longest_wavelength:
            raise InputError(
                f"{SECTION}.shortest_wavelength is {self.shortest_wavelength:g} m but must be "
                f"below {SECTION}.longest_wavelength, {self.longest_wavelength:g} m: shorten it"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Iso3095Roughness(RandomStretch):
    """Kind ``iso3095``: roughness at the limit of ISO 3095:2013.

    Attributes
    ----------
    level_db : float
        Level above the limit, the same in all bands [dB].
    """

    kind: ClassVar[str] = "iso3095"
    shortest_wavelength: Metres = 0.00315
    longest_wavelength: Metres = 0.4
    level_db: Annotated[float, Number(unit="dB", at_least=-60.0, at_most=60.0)] = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GermanTrack(RandomStretch):
    """Kind ``german``: the German vertical spectrum.

    Attributes
    ----------
    disturbance : str
        ``low`` or ``high``.
    """

    kind: ClassVar[str] = "german"
    disturbance: Annotated[str, Choice(("low", "high"))] = "low"


@dataclass(frozen=True, slots=True, kw_only=True)
class FraTrack(RandomStretch):
    """Kind ``fra``: the vertical spectrum of an FRA track class.

    Attributes
    ----------
    track_class : int
        1 to 6, the smoothest.
    """

    kind: ClassVar[str] = "fra"
    track_class: Annotated[int, Number(at_least=1, at_most=6)] = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Corrugation(Stretch):
    """Kind ``corrugation``: a sine.

    Attributes
    ----------
    wavelength, depth : float
        Length of a wave, difference of crest and trough [m].
    phase_deg : float
        Phase of the sine at position zero [deg].
    """

    kind: ClassVar[str] = "corrugation"
    wavelength: Metres = 0.05
    depth: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.02)] = 50e-6
    phase_deg: Annotated[float, Number(unit="deg")] = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """Kind ``joint``: a dip of the rail.

    Attributes
    ----------
    position : float
        Middle of the dip [m].
    length : float
        Its whole length [m].
    depth : float, optional
        Its largest drop [m].
    angle : float, optional
        Between the rail ends of a dipped joint [rad], instead of the depth, and for the shape
        ``cusp`` alone; 0.01 without either.
    shape : str
        ``cusp``, two rail ends bent down, or ``haversine``, a soft dip.
    """

    kind: ClassVar[str] = "joint"
    position: Annotated[float, Number(unit="m")]
    length: Metres = 1.0
    depth: Annotated[float | None, Number(unit="m", at_least=0.0, at_most=0.1)] = None
    angle: Annotated[float | None, Number(unit="rad", at_least=0.0, at_most=0.1)] = None
    shape: Annotated[str, Choice(("cusp", "haversine"))] = "cusp"

    def __post_init__(self) -> None:
        check_fields(self, SECTION)
        if self.depth is not None and self.angle is not None:
            raise InputError(
                f"{SECTION}.depth = {self.depth:g} and {SECTION}.angle = {self.angle:g} are both "
                "given: leave one of them out"
            )
        if self.shape == "haversine" and self.depth is None:
            raise InputError(
                f"{SECTION}.depth is missing, which a dip of the shape haversine needs: give it"
            )

    @property
    def largest_drop(self) -> float:
        """Depth of the dip [m]."""
        if self.depth is not None:
            return self.depth
        return joint_depth(0.01 if self.angle is None else self.angle, self.length)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredRail(Stretch):
    """Kind ``csv``: a measured rail.

    Attributes
    ----------
    file : str
        CSV file with the columns position [m] and drop [m], downwards positive.
    scale : float
        Factor of the drops, -1e-6 for heights in micrometres.
    """

    kind: ClassVar[str] = "csv"
    file: Annotated[str, CsvFile()]
    scale: Annotated[float, Number()] = 1.0

    def __post_init__(self) -> None:
        Stretch.__post_init__(self)
        if not self.file:
            raise InputError(f"{SECTION}.file is '' but must be the path of a .csv file")


RailSection: TypeAlias = (
    Iso3095Roughness | GermanTrack | FraTrack | Corrugation | Joint | MeasuredRail
)
"""One of the irregularities that are added up."""

KINDS: Mapping[str, type[RailSection]] = {
    kind.kind: kind
    for kind in (Iso3095Roughness, GermanTrack, FraTrack, Corrugation, Joint, MeasuredRail)
}
"""Their classes by the key ``kind``."""
