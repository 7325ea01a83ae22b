"""How a step answers to small changes of the forces at its end."""

from __future__ import annotations

from dataclasses import dataclass

from .beam_element import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """Linearised answer of a step to the forces at its end; c components, n wheels.

    Attributes
    ----------
    increments : (c, n) float array
        Change of the force increments over that of the contact forces.
    displacement : (n, n) float array
        Change of the rail displacements over that of the contact forces, increments included
        [m/N].
    correction : (c, c) float array
        Change of the increments over a miss of what is demanded of them.
    relief : (n, c) float array
        Decrease of the rail displacements over such a miss [m/N].
    """

    increments: FloatArray
    displacement: FloatArray
    correction: FloatArray
    relief: FloatArray
