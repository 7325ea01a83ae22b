"""Receptance from the complex modes of the track and the residual flexibility of the others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .points import TrackPoint

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray
    from track_fmu.eigensolver import ComplexArray
    from track_fmu.reduction import ReducedTrack

    from .preload import SupportTangent


def modal_receptance(
    track: ReducedTrack,
    frequencies: FloatArray,
    *,
    load: TrackPoint,
    response: TrackPoint,
    tangent: SupportTangent | None = None,
) -> ComplexArray:
    """Displacement at one point over the force at another [m/N], by modal superposition.

    Each mode follows ``q = rho^T f / (i omega - lambda)``, Eq. (10)-(12); what the truncated modes
    add statically is the residual flexibility, Eq. (13). What pads and ballast have beyond the
    nominal track is coupled to its modes through the receptances at their places.

    Parameters
    ----------
    track : ReducedTrack
        Modes and residual flexibility.
    frequencies : (n,) float array
        Of the excitation [Hz].
    load, response : TrackPoint
        Where the force acts and where the displacement is taken.
    tangent : SupportTangent, optional
        What pads and ballast have more of.

    Returns
    -------
    (n,) complex array
        Its argument is the phase by which the displacement leads the force.
    """
    components = _components(track, tangent)
    points = [response, load, *components]
    shape = np.array([point.shape @ track.shape[point.rows] for point in points])
    residual = np.array(
        [
            [p.shape @ track.flexibility[np.ix_(p.rows, q.rows)] @ q.shape for q in points]
            for p in points
        ]
    )
    pairs = track.weight == 2.0
    result = np.empty(len(frequencies), dtype=complex)
    for k, omega in enumerate(2.0 * np.pi * frequencies):
        among = residual + (shape / (1j * omega - track.eigenvalues)) @ shape.T
        mirrored = np.conj(shape[:, pairs])
        among += (mirrored / (1j * omega - np.conj(track.eigenvalues[pairs]))) @ mirrored.T
        result[k] = among[0, 1]
        if tangent is not None:
            added = tangent.dynamic_stiffness(float(omega))
            coupling = np.eye(len(components)) + added[:, None] * among[2:, 2:]
            result[k] -= among[0, 2:] @ np.linalg.solve(coupling, added * among[2:, 1])
    return result


def _components(track: ReducedTrack, tangent: SupportTangent | None) -> list[TrackPoint]:
    """Pads and ballast that are not the nominal ones, as points of the track."""
    if tangent is None:
        return []
    first = track.ballast_rows.start
    return [
        TrackPoint(
            rows=np.array([first + port]),
            shape=np.ones(1),
            dofs=np.zeros(0, dtype=np.intp),
            weights=np.zeros(0),
        )
        for port in tangent.ports
    ]
