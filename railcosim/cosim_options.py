"""What the command line says about a co-simulation, on top of what its file says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from orchestrator import MasterSettings

from .errors import InputError

if TYPE_CHECKING:
    from orchestrator.ssp import MasterChoices, SystemDescription

DEFAULT_TOLERANCE = 1e-4
"""Tolerance where neither the file nor the command line gives one or a fixed step."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CosimOptions:
    """Options of `railcosim cosim`; None or empty leaves a thing to the file.

    Attributes
    ----------
    stop_time : float or None
        End of the run [s].
    tolerance : float or None
        Allowed difference of prediction and result of a step, relative to nominal values; with a
        fixed step only the FMUs are told.
    algorithm : str or None
        ``newton``, ``gauss_seidel`` or ``jacobi``.
    step : float or None
        Fixed step without error control [s].
    min_step, max_step : float or None
        Smallest and largest step [s].
    audit : int or None
        Every so many accepted steps are repeated in two halves.
    events : tuple of str
        Event indicators in place of the file's.
    bonds : tuple of str
        ``force,motion`` in place of the file's.
    """

    stop_time: float | None = None
    tolerance: float | None = None
    algorithm: str | None = None
    step: float | None = None
    min_step: float | None = None
    max_step: float | None = None
    audit: int | None = None
    events: tuple[str, ...] = ()
    bonds: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.step is not None and self.max_step is not None:
            raise InputError(
                f"--step {self.step:g} fixes the step without error control and leaves --max-step "
                f"{self.max_step:g} no meaning: give one of them"
            )

    def settings(self, master: MasterChoices) -> MasterSettings:
        """Return the settings of the master.

        Parameters
        ----------
        master : MasterChoices
            What the file says. A fixed step and error control replace each other with all that
            belongs to them.

        Raises
        ------
        orchestrator.InputError
            For settings that contradict each other.
        """
        chosen: dict[str, Any] = dict(master.settings)
        if self.step is not None:
            _drop(chosen, "tolerance", "initial_step", "min_step", "max_step")
        elif "fixed_step" in chosen and (self.tolerance, self.max_step) != (None, None):
            _drop(chosen, "fixed_step", "min_step")
        if (self.min_step, self.max_step) != (None, None):
            _drop(chosen, "initial_step")
        given = {
            "tolerance": self.tolerance,
            "algorithm": self.algorithm,
            "fixed_step": self.step,
            "min_step": self.min_step,
            "max_step": self.max_step,
            "audit": self.audit,
        }
        chosen |= {name: value for name, value in given.items() if value is not None}
        if "fixed_step" not in chosen:
            chosen.setdefault("tolerance", DEFAULT_TOLERANCE)
        return MasterSettings(**{"tolerance": None, **chosen})

    def pairs(self, master: MasterChoices) -> tuple[tuple[str, str], ...]:
        """Return forces and motions of the bonds.

        Raises
        ------
        InputError
            For one that is not of the form ``force,motion``.
        """
        pairs = []
        for text in self.bonds:
            force, comma, motion = text.partition(",")
            if not (force and comma and motion):
                raise InputError(
                    f"--bond {text} must name two outputs, as in spring.force,ball.velocity"
                )
            pairs.append((force.strip(), motion.strip()))
        return tuple(pairs) or master.bonds

    def span(self, description: SystemDescription) -> tuple[float, float]:
        """Return start and end of the run [s].

        Raises
        ------
        InputError
            Where nobody says when it ends, or it ends before it starts.
        """
        start = description.start_time or 0.0
        stop = description.stop_time if self.stop_time is None else self.stop_time
        if stop is None:
            raise InputError(
                f"{description.name} does not say when to stop: give --stop-time, or a "
                "DefaultExperiment with a stopTime in the file"
            )
        if not stop > start:
            raise InputError(
                f"the stop time is {stop:g} s but must be later than the start time, {start:g} s"
            )
        return start, stop


def _drop(settings: dict[str, Any], *names: str) -> None:
    for name in names:
        settings.pop(name, None)
