"""What a laboratory would measure on a viscoelastic pad: hysteresis loops and dynamic stiffness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fmu_src.python.track_laws import CHARACTERISTIC, preloaded_pad, read_pad
from track_fmu.pad_memory import PadMemory
from track_fmu.support_factors import SupportFactors
from track_fmu.viscoelastic_pads import ViscoelasticPads

from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .track_section import Track

POINTS = 200
"""Points of a loop."""

PERIODS = 20
"""Periods after which a loop repeats itself."""

AMPLITUDE = 0.05
"""Amplitude of a loop's load, roughly, over its preload."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PadLoop:
    """A pad under a harmonic deformation about one preload.

    Attributes
    ----------
    preload : float
        [N].
    deformation, load : ndarray, shape (points + 1,)
        One closed loop, the deformation beyond that under the clip's preload [m], [N].
    static_stiffness, dynamic_stiffness : float
        Tangent at rest, and absolute value of the complex stiffness [N/m].
    loss_factor : float
        Of the latter.
    """

    preload: float
    deformation: NDArray[np.float64]
    load: NDArray[np.float64]
    static_stiffness: float
    dynamic_stiffness: float
    loss_factor: float


def pad_loops(track: Track, frequency: float) -> list[PadLoop]:
    """Deform the pad of a scenario about every preload of its table.

    Parameters
    ----------
    track : Track
        Its pad is a table over preload.
    frequency : float
        Of the deformation [Hz], above 0.

    Raises
    ------
    InputError
        For a pad of another kind, or a table that cannot be used.
    """
    if not (np.isfinite(frequency) and frequency > 0.0):
        raise InputError(f"the frequency is {frequency:g} Hz but must be above 0 Hz")
    if track.pad == "linear":
        raise InputError("track.pad is linear, which has no loop: name a table over preload")
    try:
        columns = read_pad(track.pad)
        if len(columns) == len(CHARACTERISTIC):
            raise InputError(f"table {track.pad} is a curve, which has no loop: give preloads")
        pad = preloaded_pad(track.pad, columns, track.clip_preload)
    except ValueError as error:
        raise InputError(str(error)) from error
    law = ViscoelasticPads(
        pad=pad, linear_stiffness=0.0, linear_damping=0.0, factors=SupportFactors.nominal(1)
    )
    places = np.interp(columns["preload"], *_static_curve(law, columns["preload"], track))
    return [
        _loop(law, float(preload), float(place), frequency)
        for preload, place in zip(columns["preload"], places, strict=True)
    ]


def _static_curve(
    law: ViscoelasticPads, preload: NDArray[np.float64], track: Track
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Preload over compression, finely, over the whole table."""
    softest = float(law.pad.static(np.array([-1.0])).tangent[0])
    reach = (float(preload[-1]) + track.clip_preload) / softest
    compression = np.linspace(-reach, reach, 20_001)
    return law.pad.static(compression).load + track.clip_preload, compression


def _loop(law: ViscoelasticPads, preload: float, place: float, frequency: float) -> PadLoop:
    static = law.pad.static(np.array([place]))
    amplitude = AMPLITUDE * preload / float(static.tangent[0])
    step = 1.0 / (frequency * POINTS)
    memory = PadMemory(np.zeros(1), np.array([place]), np.ones(1))
    support, rest = np.zeros(1, dtype=np.intp), np.zeros(1)
    angle = 2.0 * np.pi * np.arange(1, PERIODS * POINTS + 1) / POINTS
    deformation = place + amplitude * np.sin(angle)
    load = np.empty_like(deformation)
    for k, x in enumerate(deformation):
        over = law.during(step, memory)
        load[k] = over.force(np.array([x]), rest, support)[0]
        memory.keep(support, *over.remembered(np.array([x]), rest, support))
    last = slice(-POINTS - 1, None)
    force, phase = load[last][:-1], angle[last][:-1]
    complex_stiffness = 2.0 * np.mean(force * np.exp(-1j * phase)) * 1j / amplitude
    return PadLoop(
        preload=preload,
        deformation=deformation[last],
        load=load[last],
        static_stiffness=float(static.tangent[0]),
        dynamic_stiffness=float(np.abs(complex_stiffness)),
        loss_factor=float(complex_stiffness.imag / complex_stiffness.real),
    )
