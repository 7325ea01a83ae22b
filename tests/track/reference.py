"""A track with all that is made from its parameters, and its direct receptance."""

import numpy as np
from scipy.sparse.linalg import spsolve

from track_fmu.assembly import assemble
from track_fmu.modal import compute_basis
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import reduce_track
from track_fmu.track_model import TrackModel, TrackOptions

MIDSPAN = 25.5 * 0.65  # middle of bay 26 of 50
STATIC_LOAD = 117_720.0


class Track:
    """A track with everything that is made from its parameters."""

    def __init__(self, mode_pairs, **values):
        self.parameters = TrackParameters(**values)
        self.matrices = assemble(self.parameters)
        self.basis = compute_basis(self.matrices, mode_pairs=mode_pairs)
        self.reduced = reduce_track(self.parameters, self.matrices, self.basis)

    def without_residual(self):
        return reduce_track(self.parameters, self.matrices, self.basis, residual_flexibility=False)

    def receptance(self, frequency, position):
        """Direct receptance of the rail from the matrices, for a point on a node."""
        node = round(position / self.parameters.element_length)
        dof = self.matrices.numbering.rail[node, 0]
        return direct_receptance(
            self.matrices.stiffness, self.matrices.damping, self.matrices.mass, frequency, dof
        )


def direct_receptance(stiffness, damping, mass, frequency, dof):
    """Displacement over force at a degree of freedom [m/N]."""
    omega = 2.0 * np.pi * frequency
    force = np.zeros(stiffness.shape[0], dtype=complex)
    force[dof] = 1.0
    return spsolve((stiffness + 1j * omega * damping - omega**2 * mass).tocsc(), force)[dof]


def one_wheel(track, *, ballast=None, pad=None, **options):
    """Return the model of a track under one wheel."""
    return TrackModel(track.reduced, TrackOptions(wheels=1, **options), ballast=ballast, pad=pad)
