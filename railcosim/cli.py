"""The command line: `railcosim run`, `cosim` and the other commands."""

import signal
import sys
from typing import Annotated, Any

import typer

from . import __version__
from .commands.build import build
from .commands.check import check
from .commands.compare import compare
from .commands.cosim import cosim
from .commands.endings import say
from .commands.evaluate import evaluate
from .commands.figures import figures
from .commands.irregularity import irregularity
from .commands.load_displacement import load_displacement
from .commands.pad import pad
from .commands.receptance import receptance
from .commands.replay import replay
from .commands.report import report
from .commands.run import run
from .commands.sweep import sweep
from .commands.tune import tune
from .commands.verify import verify

USAGE_ERROR: Any = typer.BadParameter.__mro__[1]
"""What typer raises for a wrong command line; newer versions bring a click of their own."""

app = typer.Typer(
    name="railcosim",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

COMMANDS = (
    run,
    verify,
    evaluate,
    report,
    compare,
    sweep,
    figures,
    receptance,
    load_displacement,
    pad,
    irregularity,
    cosim,
    build,
    replay,
    check,
)
for command in COMMANDS:
    app.command()(command)
app.add_typer(tune, name="tune")


def main() -> None:
    """Run the command line; the process ends with 0 done, 1 the run failed, 2 wrong input."""
    signal.signal(signal.SIGTERM, _end_as_after_ctrl_c)
    try:
        code = app(sys.argv[1:] or ["--help"], standalone_mode=False)
    except USAGE_ERROR as error:
        say(f"{' '.join(error.format_message().split())}; see railcosim --help")
        code = 2
    except typer.Abort:
        code = 1
    sys.exit(code)


def _end_as_after_ctrl_c(*_: object) -> None:
    """End a run with its folders removed, also where the shell has Ctrl-C ignored, as behind &."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        raise KeyboardInterrupt
    signal.raise_signal(signal.SIGINT)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"railcosim {__version__}")
        raise typer.Exit


@app.callback()
def _railcosim(
    *,
    _: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and stop."
        ),
    ] = False,
) -> None:
    """Vertical train-track interaction as a co-simulation of two FMUs."""
