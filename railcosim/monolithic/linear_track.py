"""What the coupled system asks of a linear track, whichever coordinates that is written in.

The track is loaded and observed at *ports*: one under each wheel, which travels along the rail,
one under each sleeper, where the state-dependent ballast acts, and one at each pad if the pads bear
anything beyond springs and dampers. A force ``h`` on a port does
positive work on its displacement ``d``:

    mass y' = matrix y + sum of inputs * h,    d = output y + flexibility h,
    d' = rate y + mobility h    (at a port that stands still).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import scipy.sparse as sp

    from track_fmu.parameters import TrackParameters

Matrix: TypeAlias = Any
"""A numpy array or a sparse array of scipy; they have no type in common."""


class Ports(NamedTuple):
    """How ports see and load the state of a track; p ports, state of size n.

    Attributes
    ----------
    output, rate, inputs : array, shape (p, n)
        Displacement and velocity from the state; what a unit force adds to ``mass y'``.
    """

    output: Matrix
    rate: Matrix
    inputs: Matrix


class Feedthrough(NamedTuple):
    """What a force on one port does at once at another, wheels first; shape (p, p) each.

    Attributes
    ----------
    flexibility : ndarray
        Displacement [m/N], Eq. (13).
    mobility : ndarray
        Velocity [m/(N s)].
    """

    flexibility: NDArray[np.float64]
    mobility: NDArray[np.float64]


class BedAccelerations(NamedTuple):
    """How the ports under all sleepers accelerate; nothing on the rail moves them at once.

    Attributes
    ----------
    of_state : array, shape (supports, n)
        From the state [m/s2].
    of_bed, of_pad : ndarray, shape (supports,)
        What a unit force on the port under the same sleeper, and on that of its pad, adds [1/kg].
    """

    of_state: Matrix
    of_bed: NDArray[np.float64]
    of_pad: NDArray[np.float64]


class BentSleepers(NamedTuple):
    """What is seen of sleepers that bend, shape (supports, times) each.

    Attributes
    ----------
    seat, mean, mean_rate : ndarray
        Displacement of the rail seats and mean deflection [m], and the rate of the latter [m/s].
    moments : tuple of ndarray
        Bending moments at the rail seats and at the centres [N m], sagging positive.
    """

    seat: NDArray[np.float64]
    mean: NDArray[np.float64]
    mean_rate: NDArray[np.float64]
    moments: tuple[NDArray[np.float64], NDArray[np.float64]]


class LinearTrack(Protocol):
    """The linear track of Eq. (2) in coordinates of its own choice.

    Attributes
    ----------
    parameters : TrackParameters
        What it is a model of.
    matrix : Matrix, shape (n, n)
        See the module.
    mass : csc_array or None
        See the module; None is the unit matrix.
    scale : ndarray, shape (n,)
        How large a component of the state is where displacements are one metre.
    supports : Ports
        Under all sleepers, then at all pads if those have ports.
    beds : BedAccelerations or None
        Of the ports under the sleepers; None where accelerations do not follow from the state.
    """

    parameters: TrackParameters
    matrix: Matrix
    mass: sp.csc_array | None
    scale: NDArray[np.float64]
    supports: Ports

    @property
    def beds(self) -> BedAccelerations | None:
        """See the attribute."""
        ...

    def begin(
        self, displacement: NDArray[np.float64], velocity: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the state of given nodal displacements [m] and velocities [m/s], shape (n,)."""
        ...

    def advance(self, state: NDArray[np.float64], load: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return ``y'`` for the state and the sum of all inputs times forces, shape (n,)."""
        ...

    def wheels(self, elements: NDArray[np.intp], weights: NDArray[np.float64]) -> Ports:
        """Return the ports on given elements.

        Parameters
        ----------
        elements : ndarray, shape (wheels,)
            Elements of the rail, from 0.
        weights : ndarray, shape (wheels, 4)
            How much of their nodal displacements; those of the deflection, or of its slope.
        """
        ...

    def feedthrough(
        self, elements: NDArray[np.intp], weights: NDArray[np.float64]
    ) -> Feedthrough | None:
        """Return what forces do at once; None where they do nothing without time."""
        ...

    def nodal_moments(
        self,
        nodes: NDArray[np.intp],
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return end moments of the elements behind the given nodes [N m], sagging positive.

        Parameters
        ----------
        nodes : ndarray, shape (k,)
            Nodes from 0.
        states, rates : ndarray, shape (n, times)
            States and their derivatives.
        loads : ndarray, shape (n_coordinates, times)
            Forces on deflection and rotation of every node, on every sleeper, and on every pad if
            those have ports [N], [N m].

        Returns
        -------
        ndarray, shape (k, times)
            Without what a load within the element changes.
        """
        ...

    def pads(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return compression [m] and its rate [m/s] of every pad, shape (supports, times) each."""
        ...

    def bent_sleepers(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> BentSleepers:
        """Return what there is to see of sleepers that bend."""
        ...
