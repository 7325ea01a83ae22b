"""The passage in other tools: peak force, its error and the run time, one row per host.

    python benchmarks/hosts.py [--json]

Contact is on the track's side, steps are 100 us, nothing is iterated. The error is that of the
peak force against this project's own master, which iterates and controls its error. FMUs are the
native ones, built into a temporary folder; the last rows run those in Python. Other tools run in
`.venv-hosts` (`make hosts`); what is missing is listed with the remedy.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded

import json
from argparse import ArgumentParser
from pathlib import Path
from tempfile import TemporaryDirectory

from host_tools.answer import HostError
from host_tools.rows import Row, make_rows, own_run
from rich.console import Console
from rich.table import Table


def measure(row: Row, exact: float | None) -> dict[str, object]:
    """Run a row and return what is to be shown; `exact` is the peak force to compare with."""
    shown: dict[str, object] = {"host": row.host, "fmus": row.fmus, "remedy": ""}
    try:
        answer = row.run()
    except HostError as error:
        return shown | {"remedy": str(error)}
    (peak,) = answer.largest
    return shown | {"peak": peak, "error": peak / (exact or peak) - 1.0, "seconds": answer.seconds}


def show(results: list[dict[str, object]]) -> None:
    """Print the table."""
    table = Table()
    for heading in ("host", "FMUs"):
        table.add_column(heading)
    for heading in ("peak kN", "error %", "run time s"):
        table.add_column(heading, justify="right")
    for result in results:
        cells = [str(result["host"]), str(result["fmus"])]
        if result["remedy"]:
            table.add_row(*cells, str(result["remedy"]))
            continue
        peak, error, seconds = (float(str(result[key])) for key in ("peak", "error", "seconds"))
        table.add_row(*cells, f"{peak / 1e3:.2f}", f"{100.0 * error:+.3f}", f"{seconds:.2f}")
    Console(width=120).print(table)


def main() -> None:
    """Print the table."""
    parser = ArgumentParser(description="The passage in other tools.")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        own = measure(own_run(Path(folder)), None)
        exact = float(str(own["peak"]))
        results = [own, *(measure(row, exact) for row in make_rows(Path(folder)))]
    if options.json:
        print(json.dumps(results))
    else:
        show(results)


if __name__ == "__main__":
    main()
