"""Stiffness and damping of pads and ballast fitted to a measured receptance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import least_squares

from ..errors import InputError, RunError
from ..receptance.measured import log_residual
from ..support_values import support_properties
from ..track_data import track_parameters
from .estimate import Estimate, covariance, half_width, rounded
from .fit_checks import check_fit, check_points, check_scale, root_mean_square
from .support_receptance import SUPPORT_PARAMETERS, SupportReceptance

if TYPE_CHECKING:
    from collections.abc import Collection

    from track_fmu.beam_element import FloatArray
    from track_fmu.eigensolver import ComplexArray

    from ..receptance.measured import MeasuredReceptance
    from ..receptance.points import Place
    from ..scenario import Scenario

FARTHEST = 1000.0
"""Factor by which a parameter may move from its start, either way."""

MOST_EVALUATIONS = 50
"""A search that needs more walks along something that the data do not determine."""

WIDEST = np.log(2.0)
"""Half-width of a logarithmic confidence interval beyond which a parameter is not determined."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TunedTrack:
    """A scenario whose track has the measured receptance.

    Attributes
    ----------
    scenario : Scenario
        The one that was given, with the fitted parameters.
    estimates : tuple of Estimate
        The fitted parameters.
    points : int
        Measured frequencies used.
    amplitude_deviation : float
        Root mean square of what the fit leaves of the natural logarithm of the amplitude ratio.
    phase_deviation : float or None
        Likewise of the phase [rad]; None where no phase was measured.
    """

    scenario: Scenario
    estimates: tuple[Estimate, ...]
    points: int
    amplitude_deviation: float
    phase_deviation: float | None


def tune_to_receptance(
    scenario: Scenario,
    measured: MeasuredReceptance,
    *,
    load: Place,
    response: Place,
    hold: Collection[str] = (),
) -> TunedTrack:
    """Fit `SUPPORT_PARAMETERS` by least squares of log-amplitudes and phases.

    The unknowns are the logarithms of the parameters, so that they stay positive and their
    intervals are factors. The unloaded track is fitted.

    Parameters
    ----------
    scenario : Scenario
        The rest of the track, and where the search starts.
    measured : MeasuredReceptance
        With or without phase.
    load, response : Place
        Where it was measured.
    hold : collection of str
        Parameters that keep their value.

    Raises
    ------
    InputError
        For data that cannot determine the parameters, or that are no receptance of such a track.
    RunError
        If the search does not end.
    """
    require_equal_supports(scenario)
    fitted = [k for k, name in enumerate(SUPPORT_PARAMETERS) if name not in hold]
    start = _start(scenario, hold)
    check_points(measured, len(fitted))
    parameters = track_parameters(scenario.track)
    model = SupportReceptance(parameters, measured.frequency, load=load, response=response)
    check_scale(np.abs(model.evaluate(start)[0]), measured)

    def values(unknowns: FloatArray) -> FloatArray:
        result = start.copy()
        result[fitted] *= np.exp(unknowns)
        return result

    @lru_cache(maxsize=1)  # residuals and derivatives are asked for one after the other
    def evaluate(present: bytes) -> tuple[ComplexArray, ComplexArray]:
        return model.evaluate(np.frombuffer(present))

    def residual(unknowns: FloatArray) -> FloatArray:
        return log_residual(evaluate(values(unknowns).tobytes())[0], measured)

    def jacobian(unknowns: FloatArray) -> FloatArray:
        present = values(unknowns)
        receptance, derivatives = evaluate(present.tobytes())
        relative = (derivatives * present / receptance[:, None])[:, fitted]
        parts = [relative.real] if measured.phase is None else [relative.real, relative.imag]
        return np.concatenate(parts)

    limit = np.log(FARTHEST)
    found = least_squares(
        residual,
        np.zeros(len(fitted)),
        jacobian,
        bounds=(-limit, limit),
        max_nfev=MOST_EVALUATIONS,
    )
    points = len(measured.frequency)
    amplitude, phase = found.fun[:points], found.fun[points:]
    check_fit(amplitude)
    estimates = _estimates(found.x, jacobian(found.x), found.fun, start, fitted)
    if not found.success:
        raise RunError(
            f"the fit did not settle within {MOST_EVALUATIONS} evaluations; start closer to the "
            "measured track with --set track.pad_stiffness=... and the like"
        )
    best: dict[str, Any] = {item.name: item.value for item in estimates}
    return TunedTrack(
        scenario=replace(scenario, track=replace(scenario.track, **best)),
        estimates=estimates,
        points=points,
        amplitude_deviation=root_mean_square(amplitude),
        phase_deviation=root_mean_square(phase) if phase.size else None,
    )


def require_equal_supports(scenario: Scenario) -> None:
    """Refuse a track whose unloaded supports are not those four parameters.

    Raises
    ------
    InputError
        That names the key to leave out.
    """
    track = scenario.track
    keys = [
        f"track.{key}" for key in ("pad", "ballast") if getattr(track, key).lower().endswith(".csv")
    ]
    if not track.ballast_pulls:
        keys.append("track.ballast_pulls")
    if track.ballast_mass > 0.0:
        keys.append("track.ballast_mass")
    own = support_properties(scenario)
    if any((own[name] != (0.0 if name == "gap" else 1.0)).any() for name in own):
        keys.append("track.supports" if track.supports else "[variation]")
    if keys:
        raise InputError(
            f"a receptance is fitted by springs and dampers that are the same at every support of "
            f"the unloaded track: leave {keys[0]} out"
        )


def _start(scenario: Scenario, hold: Collection[str]) -> FloatArray:
    """Values of `SUPPORT_PARAMETERS` from which the search starts."""
    unknown = [name for name in hold if name not in SUPPORT_PARAMETERS]
    if unknown:
        raise InputError(
            f"--hold {unknown[0]} is nothing that is fitted: choose of "
            f"{', '.join(SUPPORT_PARAMETERS)}"
        )
    if set(hold) == set(SUPPORT_PARAMETERS):
        raise InputError("every parameter is held: leave at least one to be fitted")
    start = np.array([getattr(scenario.track, name) for name in SUPPORT_PARAMETERS])
    for name, value in zip(SUPPORT_PARAMETERS, start, strict=True):
        if value == 0.0 and name not in hold:
            raise InputError(
                f"track.{name} is 0 but the search must start above 0: give a guess with --set "
                f"track.{name}=..."
            )
    return start


def _estimates(
    unknowns: FloatArray,
    jacobian: FloatArray,
    residual: FloatArray,
    start: FloatArray,
    fitted: list[int],
) -> tuple[Estimate, ...]:
    """Parameters with their intervals; one that the data do not determine is refused."""
    spread = covariance(jacobian, residual)
    freedom = jacobian.shape[0] - jacobian.shape[1]
    names = [SUPPORT_PARAMETERS[number] for number in fitted]
    values = start[fitted] * np.exp(unknowns)
    widths = np.array([half_width(float(variance), freedom) for variance in np.diag(spread)])
    widths[np.abs(unknowns) > 0.99 * np.log(FARTHEST)] = np.inf
    worst = int(np.argmax(widths))
    if widths[worst] > WIDEST:
        factor = np.exp(min(widths[worst], np.log(FARTHEST)))
        raise InputError(
            f"the measured receptance does not determine {names[worst]}, which is uncertain by a "
            f"factor of {factor:.3g} or more but must be known to {np.exp(WIDEST):g}: measure "
            f"around the resonance that it acts on, or keep it with --hold {names[worst]}"
        )
    return tuple(
        Estimate(
            name=name,
            unit="N/m" if name.endswith("stiffness") else "N s/m",
            value=rounded(float(value)),
            low=float(value * np.exp(-width)),
            high=float(value * np.exp(width)),
        )
        for name, value, width in zip(names, values, widths, strict=True)
    )
