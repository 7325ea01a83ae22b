"""What the user may choose of an evaluation."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

from ..field_rules import Number
from ..fields import check_fields

TEST_SITE_RATE = 6000.0
"""Sampling frequency of the test site of Nielsen & Oscarsson (2004), section 4 [Hz]."""

TEST_SITE_BAYS = 9
"""Instrumented bays there."""

RESOLUTION = 10.0
"""Distance of the lines of a spectrum where the run is long enough [Hz]."""

UIC60_FOOT = 0.0809
"""Distance of the underside of a UIC60 rail's foot from the neutral axis [m].

Second moment of area 3038.3 cm4 over section modulus of the foot 375.5 cm3 (EN 13674-1, 60E1).
"""


class PartName(StrEnum):
    """Parts of an evaluation."""

    WHEELS = "wheels"
    SPECTRUM = "spectrum"
    THIRD_OCTAVES = "third_octaves"
    WAVELENGTHS = "wavelengths"
    DETECTOR = "detector"
    BAYS = "bays"
    GAUGES = "gauges"
    SUPPORTS = "supports"


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluation:
    """Choices of an evaluation.

    Attributes
    ----------
    rate : float
        Sampling frequency of spectra and of the wheel load detector [Hz].
    resolution : float, optional
        Distance of the lines of a spectrum [Hz]; its segments last the inverse. `RESOLUTION`
        without, or as fine as a shorter run allows.
    bays : int
        Bays of the wheel load detector, the struck bay in their middle.
    bay_share : float
        Part of every bay, in its middle, in which the detector sees a wheel.
    gauge_depth : float
        Distance of the strain gauges below the neutral axis of the rail [m]; that of the foot of
        a UIC60 rail without.

    Raises
    ------
    InputError
        For a value outside its limits.
    """

    rate: Annotated[float, Number(unit="Hz", at_least=100.0, at_most=1e5)] = TEST_SITE_RATE
    resolution: Annotated[float | None, Number(unit="Hz", above=0.0)] = None
    bays: Annotated[int, Number(unit="bays", at_least=1)] = TEST_SITE_BAYS
    bay_share: Annotated[float, Number(above=0.0, at_most=1.0)] = 1.0
    gauge_depth: Annotated[float, Number(unit="m", at_least=-0.5, at_most=0.5)] = UIC60_FOOT

    def __post_init__(self) -> None:
        check_fields(self, "evaluation")
