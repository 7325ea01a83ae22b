"""The result of a co-simulation: labelled series of all outputs, and its numbers."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from rich.table import Table

from .dataset import attempt_variables
from .run_record import attempts, programs, statistics
from .summary import steps_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from orchestrator import MasterSettings, Outcome, Recorder, Variable

DTYPES = {"Real": np.float64, "Integer": np.int64, "Enumeration": np.int64, "Boolean": np.bool_}
"""How values of a type are kept."""

EXTRAS = ("audit", "bonds")
"""What the master reports only where it was asked to."""

SHOWN = 20
"""Final values that the table for the terminal shows."""


def label_result(
    name: str, recorder: Recorder, outcome: Outcome, settings: MasterSettings
) -> xr.Dataset:
    """Label the records of a run.

    Parameters
    ----------
    name : str
        Name of the system.
    recorder : Recorder
        Its outputs at the accepted times.
    outcome : Outcome
        How the run went.
    settings : MasterSettings
        Settings of the master.

    Returns
    -------
    xarray.Dataset
        Every output as ``component.variable`` over ``time``, and the step log over ``attempt``;
        units and long name on every variable.
    """
    series = {
        path: ("time", _typed(recorder[path], variable), _attributes(variable))
        for path, variable in recorder.variables.items()
    }
    time = ("time", recorder.time, {"units": "s", "long_name": "time"})
    return xr.Dataset(
        series | attempt_variables(attempts(outcome)),
        coords={"time": time},
        attrs={
            "Conventions": "CF-1.11",
            "title": f"Co-simulation of {name}",
            "master": json.dumps(asdict(settings)),
            **programs(),
            **statistics(outcome),
        },
    )


def summarise_cosim(result: xr.Dataset) -> dict[str, Any]:
    """Return the numbers that ``--json`` prints.

    Returns
    -------
    dict
        ``end_time`` and ``wall_time`` [s], ``steps``, the sentences of ``warnings`` and
        ``unreliable``, ``audit`` and ``bonds`` where there are any and the ``final`` value of
        every output.
    """
    return {
        "end_time": float(result.attrs["simulated_time"]),
        "steps": asdict(steps_of(result)),
        "wall_time": float(result.attrs["wall_time"]),
        "warnings": result.attrs["warnings"].splitlines(),
        "unreliable": result.attrs["unreliable"].splitlines(),
        **{name: json.loads(result.attrs[name]) for name in EXTRAS if name in result.attrs},
        "final": {
            str(name): series.to_numpy()[-1].item()
            for name, series in result.data_vars.items()
            if series.dims == ("time",)
        },
    }


def cosim_table(result: xr.Dataset) -> Table:
    """Lay the numbers out for the terminal, the first of the final values among them."""
    summary = summarise_cosim(result)
    table = Table(title=result.attrs["title"], show_header=False)
    table.add_column("what")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for name, value in list(summary["final"].items())[:SHOWN]:
        shown = f"{value:.9g}" if isinstance(value, float) else str(value)
        table.add_row(name, shown, result[name].attrs["units"])
    if len(summary["final"]) > SHOWN:
        table.add_row(f"and {len(summary['final']) - SHOWN} more", "", "")
    steps = summary["steps"]
    rejected = {cause: n for cause, n in steps["rejected"].items() if n}
    table.add_section()
    table.add_row("accepted steps", str(steps["accepted"]), "")
    causes = ", ".join(f"{n} {cause}" for cause, n in rejected.items())
    table.add_row("rejected attempts", str(sum(rejected.values())), causes)
    table.add_row("coupling iterations", str(steps["iterations"]), "")
    table.add_row("end time", f"{summary['end_time']:.9g}", "s")
    table.add_row("wall time", f"{summary['wall_time']:.2f}", "s")
    return table


def _typed(values: NDArray[np.float64], variable: Variable) -> NDArray[np.generic]:
    return values.astype(DTYPES[variable.type], copy=False)


def _attributes(variable: Variable) -> dict[str, str]:
    return {"units": variable.unit or "1", "long_name": variable.description or variable.name}
