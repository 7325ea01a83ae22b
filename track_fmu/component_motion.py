"""How the state-dependent components move at the end of a step: affine maps of all forces."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .beam_element import FloatArray
from .component_law import Tangents
from .components import ActiveComponents
from .eigensolver import ComplexArray
from .reduction import ReducedTrack


class StepLoads(NamedTuple):
    """The loads of a step as its modes see them; n wheels, S modes.

    Attributes
    ----------
    free : (S,) complex array
        Modal state that the step would end with if there were no forces at its end.
    contact : (n, S) complex array
        Modal displacements at the wheels.
    contact_end, end : (S,) complex array
        Factors of the modal loads of contact forces and increments at the end of the step [s].
    residual : (c, n) float array
        Residual flexibility of the components under the contact forces [m/N].
    """

    free: ComplexArray
    contact: ComplexArray
    contact_end: ComplexArray
    end: ComplexArray
    residual: FloatArray


class _Map(NamedTuple):
    """``free + contact @ F - active @ g``, shapes (c,), (c, n) and (c, c)."""

    free: FloatArray
    contact: FloatArray
    active: FloatArray

    def of(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Value under contact forces and increments at the end of the step."""
        return np.asarray(self.free + self.contact @ forces - self.active @ increment)


class ComponentMotion:
    """Deformations, rates and, if a law asks for them, accelerations of the active components.

    With ``q`` and ``Q`` the modal states and loads at the end of the step they are

        x   = Re sum w rho q + residual flexibility
        x'  = Re sum w rho (lambda q + Q)
        x'' = Re sum w rho lambda (lambda q + Q)

    For the complete set of modes ``Re sum w rho rho^T = 0`` and ``Re sum w lambda rho rho^T`` is
    the inverse of the mass matrix: ``Q`` vanishes in the rate, and an acceleration answers to a
    force at once. A truncated set that holds the sleepers' modes has that inverse in their rows to
    a few parts in ten thousand. The derivative of the rate's own ``Q``, which the complete set has
    not, and that of the residual flexibility are left out of the acceleration: their factors on a
    force, over the step and its square, would make short steps unstable.

    Parameters
    ----------
    track : ReducedTrack
        Modes.
    active : ActiveComponents
        The components.
    loads : StepLoads
        Of the step.
    """

    def __init__(self, track: ReducedTrack, active: ActiveComponents, loads: StepLoads) -> None:
        weighted = active.shape * track.weight
        free, contact, contact_end, end, residual = loads
        self.deformation = _Map(
            np.real(weighted @ free),
            np.real(weighted @ (contact * contact_end).T) + residual,
            np.real(weighted @ (active.shape * end).T) + active.flexibility,
        )
        driven = weighted * track.eigenvalues
        self.rate = _Map(
            np.real(driven @ free),
            np.real((driven * contact_end + weighted) @ contact.T),
            np.real((driven * end + weighted) @ active.shape.T),
        )
        self.acceleration: _Map | None = None
        if active.inertial:
            twice = driven * track.eigenvalues
            self.acceleration = _Map(
                np.real(twice @ free),
                np.real((twice * contact_end + driven) @ contact.T),
                np.real((twice * end + driven) @ active.shape.T),
            )

    def under(
        self, forces: FloatArray, increment: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray | None]:
        """Deformations [m], rates [m/s] and accelerations [m/s2] under given forces, (c,) each."""
        acceleration = self.acceleration
        return (
            self.deformation.of(forces, increment),
            self.rate.of(forces, increment),
            None if acceleration is None else acceleration.of(forces, increment),
        )

    def contact_demand(self, tangents: Tangents) -> FloatArray:
        """Change of what the laws demand over that of the contact forces, shape (c, n)."""
        demand = (
            tangents.stiffness[:, None] * self.deformation.contact
            + tangents.damping[:, None] * self.rate.contact
        )
        if self.acceleration is not None:
            demand += tangents.mass[:, None] * self.acceleration.contact
        return demand

    def increment_demand(self, tangents: Tangents) -> FloatArray:
        """Decrease of what the laws demand over a rise of the increments, shape (c, c)."""
        demand = (
            tangents.stiffness[:, None] * self.deformation.active
            + tangents.damping[:, None] * self.rate.active
        )
        if self.acceleration is not None:
            demand += tangents.mass[:, None] * self.acceleration.active
        return demand
