"""Every host that runs the passage, with every build of the FMUs that it takes."""

import os
import shutil
import sys
import sysconfig
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise

from .answer import Answer, HostError
from .c_host import CHost, compile_host
from .fmpy_host import FmpyHost
from .python_host import NAMES, READ_PACKAGES, PythonHost
from .systems import Build, Systems

WINDOWS = "x86_64-windows"


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A host with a build of the FMUs.

    Attributes
    ----------
    host : str
        The host.
    fmus : str
        Which FMUs, and whether they come in an SSP package.
    run : callable
        Runs the passage.
    """

    host: str
    fmus: str
    run: Callable[[], Answer]


def own_run(folder: Path) -> Row:
    """Return `railcosim run` with native FMUs: contact in the vehicle, iterated, error control."""

    def run() -> Answer:
        summary = summarise(
            run_passage(read_scenario(None, ()), fmus="native", directory=folder / "native")
        )
        peak = summary.peak_contact_force
        assert peak is not None
        return Answer(seconds=summary.wall_time, final=(), largest=(peak,))

    return Row(host="railcosim run", fmus="Track and Vehicle, native 2.0", run=run)


def make_rows(folder: Path) -> list[Row]:
    """Return all rows; FMUs and programs are made in the folder when a row first needs them."""
    systems = Systems(folder=folder)
    windows = Systems(folder=folder / "windows", platforms=(WINDOWS,))
    program = cache(partial(compile_host, folder))
    builds: tuple[Build, ...] = ("native 2.0", "native 3.0")
    rows = [_row("fmpy", systems, build, FmpyHost) for build in builds]
    for name in NAMES:
        make = partial(PythonHost, name)
        taken = builds[:1] if name == "libcosimpy" else builds  # libcosim has no FMI 3.0
        rows += [_row(name, systems, build, make) for build in taken]
        if name in READ_PACKAGES:
            rows += [_row(name, systems, builds[0], make, packed=True)]
    rows += [_row("C program", systems, b, lambda: CHost(program=program())) for b in builds]
    under_wine = partial(_under_wine, folder)
    rows += [_row("C program, Windows", windows, build, under_wine) for build in builds]
    rows.append(_row("fmpy", systems, "python 2.0", FmpyHost))
    rows.append(
        _row(
            "C program, LD_PRELOAD",
            systems,
            "python 2.0",
            lambda: CHost(program=program(), environment=preloaded_python()),
        )
    )
    return rows


def preloaded_python() -> Mapping[str, str]:
    """Return the environment in which a program without Python runs FMUs made with pythonfmu.

    Raises
    ------
    HostError
        If this interpreter has no shared library.
    """
    folder, name = (sysconfig.get_config_var(key) for key in ("LIBDIR", "INSTSONAME"))
    library = Path(str(folder)) / str(name)
    if ".so" not in library.name or not library.exists():
        raise HostError("this Python has no libpython.so; install one that has", missing=True)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    kept = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    return kept | {"LD_PRELOAD": str(library), "PATH": path}


def _row(
    host: str,
    systems: Systems,
    build: Build,
    make: Callable[[], CHost | FmpyHost | PythonHost],
    *,
    packed: bool = False,
) -> Row:
    def run() -> Answer:
        tool = make()
        if isinstance(tool, PythonHost):
            assert tool.version  # before anything is built for it
        return tool.run(systems.job(build, packed=packed))

    return Row(host=host, fmus=f"{build}{', SSP' * packed}", run=run)


def _under_wine(folder: Path) -> CHost:
    """The Windows program under Wine, in a configuration of its own."""
    wine = shutil.which("wine") or shutil.which("wine64")
    if sys.platform != "win32" and wine is None:
        raise HostError("Wine is missing; install it (on Debian: apt install wine)", missing=True)
    program = folder / "host.exe"
    if not program.exists():
        compile_host(folder, WINDOWS)
    quiet = {"WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"}
    return CHost(
        program=program,
        target=WINDOWS,
        launcher=(wine,) if wine else (),
        environment=os.environ | quiet,
    )
