"""Receptance of a track and its derivatives by the properties of its supports."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..receptance.dynamic_stiffness import DynamicStiffness
from ..receptance.points import track_point

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray
    from track_fmu.eigensolver import ComplexArray
    from track_fmu.parameters import TrackParameters

    from ..receptance.points import Place

SUPPORT_PARAMETERS = ("pad_stiffness", "pad_damping", "ballast_stiffness", "ballast_damping")
"""Keys of ``[track]`` that all supports share and that a receptance can tell."""


class SupportReceptance:
    """Receptance at given frequencies as a function of `SUPPORT_PARAMETERS`.

    Parameters
    ----------
    parameters : TrackParameters
        Everything else about the track.
    frequencies : (m,) float array
        Of the excitation [Hz].
    load, response : Place
        Where the force acts and where the displacement is taken.
    """

    def __init__(
        self,
        parameters: TrackParameters,
        frequencies: FloatArray,
        *,
        load: Place,
        response: Place,
    ) -> None:
        self._parameters = parameters
        self._frequencies = frequencies
        self._points = [track_point(parameters, place) for place in (load, response)]

    def evaluate(self, values: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Receptance and its derivatives at given values of `SUPPORT_PARAMETERS`.

        The derivative of ``H = o^T Z^-1 f`` by a stiffness is ``-(Z^-1 o)^T dZ (Z^-1 f)``, by a
        damping ``i omega`` times as much.

        Parameters
        ----------
        values : (4,) float array
            Stiffness and damping of pads, then of ballast [N/m], [N s/m].

        Returns
        -------
        receptance : (m,) complex array
            Displacement over force [m/N].
        derivatives : (m, 4) complex array
            Of the receptance by the values.
        """
        changed: dict[str, Any] = dict(zip(SUPPORT_PARAMETERS, map(float, values), strict=True))
        track = DynamicStiffness(replace(self._parameters, **changed))
        forces = np.stack([track.load(point) for point in self._points], axis=1)
        pads = track.matrices.pad_incidence
        springs = ((slice(0, 2), pads @ pads.T), (slice(2, 4), track.matrices.beds))
        receptance = np.empty(len(self._frequencies), dtype=complex)
        derivatives = np.empty((len(self._frequencies), len(values)), dtype=complex)
        for k, frequency in enumerate(self._frequencies):
            displacement = track.solve(float(frequency), forces)
            receptance[k] = forces[:, 1] @ displacement[:, 0]
            rate = np.array([1.0, 2j * np.pi * frequency])
            for part, matrix in springs:
                derivatives[k, part] = -(displacement[:, 0] @ (matrix @ displacement[:, 1])) * rate
        return receptance, derivatives
