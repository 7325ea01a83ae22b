"""The receptance of the track of a scenario: what is loaded where, under which preload."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.linalg import LinAlgError

from fmu_src.python.basis_cache import cached_basis
from track_fmu.assembly import assemble
from track_fmu.eigensolver import EigenvalueError
from track_fmu.reduction import reduce_track

from ..errors import InputError, RunError
from ..load_displacement import HEAVIEST
from ..track_data import is_linear, track_parameters
from .dynamic_stiffness import DynamicStiffness
from .modal import modal_receptance
from .peaks import Peak, find_peaks
from .points import Place, track_point

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray
    from track_fmu.eigensolver import ComplexArray
    from track_fmu.parameters import TrackParameters
    from track_fmu.reduction import ReducedTrack

    from ..scenario import Scenario
    from .preload import SupportTangent

METHODS = ("direct", "modal")
"""Ways to a receptance: the dynamic stiffness of the whole track, or its modes."""

NEIGHBOURHOOD = 4.0
"""By which factor beyond the frequencies asked for a resonance is compared with what is around."""


def midspan(scenario: Scenario) -> Place:
    """Middle of the bay in which the flat strikes."""
    return Place(position=scenario.gauge_positions[0])


@dataclass(frozen=True, kw_only=True, eq=False)
class ReceptanceStudy:
    """What is loaded where, at which frequencies and under which preload.

    Attributes
    ----------
    scenario : Scenario
        Its track is the one studied.
    load, response : Place
        Where the force acts and where the displacement is taken.
    preload : float
        Standing load on the rail where the force acts [N]; pads and ballast are linearised about
        the equilibrium under it. 0: the unloaded track.

    Raises
    ------
    InputError
        For a place that is not on the track, or a preload without effect.
    """

    scenario: Scenario
    load: Place
    response: Place
    preload: float = 0.0

    def __post_init__(self) -> None:
        for place in (self.load, self.response):
            track_point(self._parameters, place)
        if not 0.0 <= self.preload <= HEAVIEST:
            raise InputError(
                f"the preload is {self.preload:g} N but must be from 0 to {HEAVIEST:g} N"
            )
        if self.preload > 0.0 and is_linear(self.scenario):
            raise InputError(
                f"a preload of {self.preload:g} N changes nothing on a linear track: leave it out "
                "or set track.ballast=state_dependent"
            )

    def receptance(self, frequencies: FloatArray, method: str = "direct") -> ComplexArray:
        """Displacement over force [m/N], shape (n,), at frequencies [Hz] by one of `METHODS`.

        Raises
        ------
        RunError
            If the parameters of the track are such that there is none.
        """
        load, response = (track_point(self._parameters, p) for p in (self.load, self.response))
        if method == "direct":
            return self._dynamic_stiffness.receptance(frequencies, load=load, response=response)
        return modal_receptance(
            self._reduced,
            frequencies,
            load=load,
            response=response,
            tangent=self._tangent,
        )

    def peaks(self, lowest: float, highest: float, method: str) -> list[Peak]:
        """Resonances between two frequencies [Hz], which stand out from a wider neighbourhood."""

        def amplitude(frequencies: FloatArray) -> FloatArray:
            return np.abs(self.receptance(frequencies, method))

        found = find_peaks(lowest / NEIGHBOURHOOD, highest * NEIGHBOURHOOD, amplitude)
        return [peak for peak in found if lowest <= peak.frequency <= highest]

    @cached_property
    def _parameters(self) -> TrackParameters:
        return track_parameters(self.scenario.track)

    @cached_property
    def _dynamic_stiffness(self) -> DynamicStiffness:
        return DynamicStiffness(self._parameters, self._tangent)

    @cached_property
    def _tangent(self) -> SupportTangent | None:
        from .preload import support_tangent  # noqa: PLC0415 - loads laws that other uses spare

        point = track_point(self._parameters, Place(position=self._along))
        return support_tangent(self.scenario, point=point, force=self.preload)

    @property
    def _along(self) -> float:
        """Where the preload stands on the rail [m]."""
        return self.load.along(self._parameters)

    @cached_property
    def _reduced(self) -> ReducedTrack:
        parameters, matrices = self._parameters, assemble(self._parameters)
        pairs = self.scenario.track.retained_pairs
        try:
            with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # modes are checked
                basis = cached_basis(parameters, matrices, mode_pairs=pairs)
        except (EigenvalueError, LinAlgError) as error:
            raise RunError(
                f"the modes of the track cannot be found ({error}); check the keys of [track], or "
                "use --method direct"
            ) from error
        return reduce_track(
            parameters,
            matrices,
            basis,
            residual_flexibility=self.scenario.track.residual_flexibility,
        )
