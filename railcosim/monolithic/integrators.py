"""Implicit integrators of scipy for ``mass y' = f(t, y)`` with a sparse mass matrix."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias, cast

import numpy as np
from scipy.integrate import BDF, Radau

from ..errors import InputError
from .jacobian import jacobian

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from .system import CoupledSystem

Method: TypeAlias = Literal["Radau", "BDF"]
"""Integrators by their names in scipy."""

METHODS: Mapping[str, Callable[..., Any]] = {"Radau": Radau, "BDF": BDF}


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy:
    """Which integrator is used, and how tightly.

    Attributes
    ----------
    method : {"Radau", "BDF"}
        Radau is L-stable at order 5. BDF takes ten times the steps: its higher orders are unstable
        for the hardly damped vibrations of the rail.
    rtol : float
        Relative tolerance of every component of the state.
    atol : float
        Absolute tolerance of displacements [m]; those of velocities and modes follow from it.

    Raises
    ------
    InputError
        For another method or a tolerance out of range.
    """

    method: Method = "Radau"
    rtol: float = 1e-4
    atol: float = 1e-8

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise InputError(f"method is {self.method!r} but must be one of {', '.join(METHODS)}")
        for name, least, most in (("rtol", 1e-10, 1e-2), ("atol", 1e-14, 1e-6)):
            value = getattr(self, name)
            if not least <= value <= most:
                raise InputError(f"{name} is {value!r} but must lie between {least:g} and {most:g}")


class Stepper(Protocol):
    """What is used of an integrator of scipy; see `scipy.integrate.OdeSolver`."""

    t: float
    t_old: float
    y: NDArray[np.float64]
    h_abs: float
    status: str
    nfev: int
    nlu: int

    def step(self) -> str | None:
        """Take a step; return why there is none."""
        ...

    def dense_output(self) -> Callable[[float], NDArray[np.float64]]:
        """Return the solution over the last step."""
        ...


def start_integrator(
    system: CoupledSystem,
    accuracy: Accuracy,
    *,
    time: float,
    state: NDArray[np.float64],
    end: float,
    first_step: float,
) -> Stepper:
    """Start an integrator at a time [s] and state, towards an end [s].

    With a mass matrix ``D`` the integrator's systems ``(c I - D^-1 J) x = b`` are solved as
    ``(c D - J) x = D b``, so that what is factorised stays sparse: scipy's integrators take unit
    matrix and solution from two attributes of theirs.
    """
    solver: Any = METHODS[accuracy.method](
        system.rates,
        time,
        state,
        end,
        rtol=accuracy.rtol,
        atol=accuracy.atol * system.scale,
        jac=partial(jacobian, system),
        first_step=first_step,
    )
    mass = system.mass
    if mass is not None:
        solver.I = mass
        solver.solve_lu = lambda factors, right: factors.solve(mass @ right)
    return cast("Stepper", solver)
