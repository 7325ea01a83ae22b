"""Inputs of a slave: one array as a host sets them, with a view of it for each group."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .variables import Variable

FloatArray = NDArray[np.float64]


class GroupedInputs:
    """Values of all inputs, those of a group side by side.

    Parameters
    ----------
    variables : sequence of Variable
        The inputs; those of a group stand together, in ascending index.

    Attributes
    ----------
    values : (k,) float array
        As last set, the start values at first; it stays the same array.
    groups : dict of str to float array
        Views of ``values``, by the name of the group.
    places : dict of str to int
        Place in ``values`` by the name of the input.
    """

    def __init__(self, variables: Sequence[Variable]) -> None:
        self.values: FloatArray = np.array([v.start for v in variables], dtype=float)
        self.places = {v.name: place for place, v in enumerate(variables)}
        self.groups: dict[str, FloatArray] = {}
        for place, variable in enumerate(variables):
            if variable.index == 0:
                size = sum(other.group == variable.group for other in variables)
                self.groups[variable.group] = self.values[place : place + size]
