"""The section of a scenario file that says how the co-simulation is stepped."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

from .errors import InputError
from .field_rules import Choice, Number
from .fields import check_fields

DEFAULT_MAX_STEP = 2e-4
"""Largest step of the master [s]: it resolves the rail's modes to 1 kHz."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Master:
    """Keys of ``[master]``: how the co-simulation is stepped.

    Attributes
    ----------
    algorithm : str, optional
        ``newton`` iterates every step to convergence; ``gauss_seidel`` and ``jacobi`` do not.
        Without, newton with contact on the vehicle's side and jacobi with contact on the track's.
    tolerance : float
        Allowed difference of prediction and result of a step, relative to nominal values.
    coupling_tolerance : float
        Largest residual of the iteration, relative to nominal values.
    step : float, optional
        Fixed step without error control [s]; failing steps are still divided.
    initial_step, min_step, max_step : float, optional
        First, smallest and largest step under error control [s]; see `largest_step`.
    max_iterations : int
        How often one attempt may step the FMUs.
    max_rejections : int
        Rejected attempts in a row that end the run.
    """

    algorithm: Annotated[str | None, Choice(("newton", "gauss_seidel", "jacobi"))] = None
    tolerance: Annotated[float, Number(above=0.0)] = 2e-3
    coupling_tolerance: Annotated[float, Number(above=0.0)] = 1e-6
    step: Annotated[float | None, Number(unit="s", above=0.0, at_most=1e-2)] = None
    initial_step: Annotated[float | None, Number(unit="s", above=0.0, at_most=1e-2)] = None
    min_step: Annotated[float | None, Number(unit="s", above=0.0, at_most=1e-2)] = None
    max_step: Annotated[float | None, Number(unit="s", above=0.0, at_most=1e-2)] = None
    max_iterations: Annotated[int, Number(at_least=1)] = 30
    max_rejections: Annotated[int, Number(at_least=1)] = 100

    def __post_init__(self) -> None:
        check_fields(self, "master")
        if self.step is not None and (self.initial_step, self.max_step) != (None, None):
            raise InputError(
                f"master.step = {self.step:g} s leaves master.initial_step and master.max_step no "
                "meaning: leave either it or them out"
            )
        if self.is_explicit and self.step is None:
            raise InputError(
                f"master.algorithm is {self.algorithm!r}, which takes steps of one size only: give "
                "master.step, 2.5e-5 s or less (1e-4 s or less with contact on the track side), or "
                "use newton"
            )
        names = ("min_step", "initial_step", "step", "max_step")
        sizes = [(n, value) for n in names if (value := getattr(self, n)) is not None]
        for (small, lower), (large, upper) in pairwise(sizes):
            if lower > upper:
                raise InputError(
                    f"master.{small} is {lower:g} s but must be at most master.{large}, which is "
                    f"{upper:g} s: lower the one or raise the other"
                )

    @property
    def is_explicit(self) -> bool:
        """Whether steps are taken once and for all."""
        return self.algorithm in {"gauss_seidel", "jacobi"}

    @property
    def largest_step(self) -> float:
        """Largest step under error control [s], not below a smallest one that is given."""
        return self.max_step or max(DEFAULT_MAX_STEP, self.min_step or 0.0)
