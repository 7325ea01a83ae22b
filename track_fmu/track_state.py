"""The complete state of a track as one flat array."""

from __future__ import annotations

import numpy as np

from .beam_element import FloatArray
from .eigensolver import ComplexArray
from .pad_memory import PadMemory


class TrackState:
    """Named views into one float64 array; copying that array saves everything.

    Attributes
    ----------
    flat : (size,) float array
        The state; all other attributes are views into it.
    position, speed : (wheels,) float array
        Of the wheels at the last communication point [m], [m/s].
    force, force_rate : (wheels,) float array
        Contact forces there [N] and their slope in the last step [N/s].
    displacement : (wheels,) float array
        Rail displacement under the wheels [m].
    increment, increment_rate : (components,) float array
        State-dependent forces of ballast and pads [N] and their slope in the last step [N/s].
    pads : PadMemory
        What viscoelastic pads remember, (supports,) each.
    modal, load : (S,) complex array
        Modal states ``q`` and modal loads ``Q``.
    offset : (1,) float array
        Bays by which the window of an endless track has moved; 0 for an ordinary one.
    """

    __slots__ = (
        "displacement",
        "flat",
        "force",
        "force_rate",
        "increment",
        "increment_rate",
        "load",
        "modal",
        "offset",
        "pads",
        "position",
        "speed",
    )

    def __init__(self, *, wheels: int, components: int, modes: int) -> None:
        supports = components // 2
        self.flat: FloatArray = np.zeros(5 * wheels + 2 * components + 3 * supports + 4 * modes + 1)
        lengths = [wheels] * 5 + [components] * 2 + [supports] * 3 + [2 * modes] * 2 + [1]
        parts = np.split(self.flat, np.cumsum(lengths)[:-1])  # views, not copies
        self.position, self.speed, self.force, self.force_rate, self.displacement = parts[:5]
        self.increment, self.increment_rate = parts[5:7]
        self.pads = PadMemory(*parts[7:10])
        self.modal: ComplexArray = parts[10].view(np.complex128)
        self.load: ComplexArray = parts[11].view(np.complex128)
        self.offset = parts[12]
