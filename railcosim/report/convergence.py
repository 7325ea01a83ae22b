"""What smaller steps change: the same passage at other settings of the master."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import log2
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..errors import RunError
from ..scenario_file import from_toml
from ..strike import WINDOW
from ..summary import Summary, summarise

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from ..scenario import Scenario

HALVINGS = 3
"""How often the fixed step is halved."""


class Runner(Protocol):
    """Runs a passage; the label says which one it is."""

    def __call__(self, scenario: Scenario, label: str) -> xr.Dataset:
        """Return the result."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One setting and what came of it.

    Attributes
    ----------
    label : str
        The setting in words.
    step : float or None
        Fixed step [s], None under error control.
    summary : Summary
        The numbers.
    deviation : float
        Root mean square of the difference to the finest case of the contact force of the flat's
        wheel, in the summary's window, over the static load.
    """

    label: str
    step: float | None
    summary: Summary
    deviation: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Convergence:
    """The settings that were tried, the finest last.

    Attributes
    ----------
    cases : tuple of Case
        First the passage of the page.
    orders : tuple of float
        Observed order of the contact force: log2 of the ratio of the differences that two
        successive halvings of the fixed step make.
    """

    cases: tuple[Case, ...]
    orders: tuple[float, ...]


def study(passage: xr.Dataset, run: Runner) -> Convergence:
    """Run a passage with a smaller tolerance and with fixed steps, each half of the one before.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, which is the first case.
    run : callable
        Runs the others.

    Returns
    -------
    Convergence
        All cases and the observed order.

    Raises
    ------
    RunError
        Where one of them fails or is interrupted.
    """
    scenario = from_toml(passage.attrs["scenario"])
    times = _times(passage, scenario.master.step or scenario.master.largest_step)
    summaries, forces = [summarise(passage)], [_force(passage, times)]
    others = refinements(scenario)
    for other in others:  # one result in memory at a time
        result = _complete(run(other, _label(other)), _label(other))
        summaries.append(summarise(result))
        forces.append(_force(result, times))
    settings = [scenario, *others]
    static = float(passage["static_wheel_load"])
    cases = tuple(
        Case(
            label=_label(setting),
            step=setting.master.step,
            summary=summary,
            deviation=_size(force - forces[-1]) / static,
        )
        for setting, summary, force in zip(settings, summaries, forces, strict=True)
    )
    fixed = [force for case, force in zip(cases, forces, strict=True) if case.step is not None]
    return Convergence(cases=cases, orders=_orders(fixed))


def refinements(scenario: Scenario) -> list[Scenario]:
    """Return the other settings of a passage, the finest last."""
    master = scenario.master
    if master.step is not None:
        sizes = [master.step / 2**k for k in range(1, HALVINGS + 1)]
        return [_at_step(scenario, size) for size in sizes]
    tighter = replace(scenario, master=replace(master, tolerance=master.tolerance / 10.0))
    sizes = [master.largest_step / 2**k for k in range(HALVINGS + 1)]
    return [tighter, *(_at_step(scenario, size) for size in sizes)]


def _at_step(scenario: Scenario, step: float) -> Scenario:
    master = replace(scenario.master, step=step, initial_step=None, max_step=None, min_step=None)
    return replace(scenario, master=master)


def _label(scenario: Scenario) -> str:
    master = scenario.master
    if master.step is not None:
        return f"fixed steps of {1e6 * master.step:g} µs"
    return f"tolerance {master.tolerance:g}"


def _complete(result: xr.Dataset, label: str) -> xr.Dataset:
    """Let through what is a whole and sound result."""
    if not result.attrs["complete"] or result.attrs["unreliable"]:
        reason = result.attrs["unreliable"] or result.attrs["stop_reason"]
        raise RunError(f"the passage with {label} ended early or is wrong, because {reason}")
    return result


def _times(passage: xr.Dataset, step: float) -> NDArray[np.float64]:
    """Return the multiples of a step in the window, which all fixed steps reach."""
    distance, time = passage["distance"].to_numpy(), passage["time"].to_numpy()
    start, end = np.interp(WINDOW, distance, time)
    return step * np.arange(np.ceil(start / step), np.floor(end / step) + 1.0)


def _force(result: xr.Dataset, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the contact force of the flat's wheel at some times [N]."""
    return np.interp(
        times, result["time"], result["contact_force"].sel(wheel=int(result["flat_wheel"]))
    )


def _size(values: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _orders(forces: list[NDArray[np.float64]]) -> tuple[float, ...]:
    """Return the order between each three successive steps; none where nothing changes."""
    changes = [_size(coarse - fine) for coarse, fine in pairwise(forces)]
    return tuple(log2(a / b) for a, b in pairwise(changes) if a > 0.0 and b > 0.0)
