"""The FMUs of a scenario: which builds there are, and how one is brought up to date."""

from __future__ import annotations

from typing import TYPE_CHECKING

from numpy.linalg import LinAlgError

from fmu_src.building import FmuPaths, ensure_fmus, ensure_native_fmus, folder_of
from fmu_src.native.compiler import CompilationError
from fmu_src.native.models import native_track
from fmu_src.structure import PAIRS, Structure
from track_fmu.eigensolver import EigenvalueError

from .dataset import count
from .errors import BuildError, InputError, RunError
from .start_values import track_constants

if TYPE_CHECKING:
    from collections.abc import Callable, Collection
    from pathlib import Path
    from typing import Literal

    from .scenario import Scenario
    from .signals import ContactSide


def usual_build(contact: ContactSide) -> str:
    """Return the build that runs if nothing is said: ``native`` where it has been built."""
    paths = [folder_of("native") / Structure().file_name(kind) for kind in PAIRS[contact]]
    return "native" if all(path.is_file() for path in paths) else "python"


def build_for(
    scenario: Scenario,
    fmus: str = "python",
    *,
    contact: ContactSide = "vehicle",
    directory: Path | None = None,
    fmi_version: Literal[2, 3] = 2,
    platforms: Collection[str] | None = None,
    notify: Callable[[str], None] | None = None,
) -> FmuPaths:
    """Build the FMUs of a scenario where they are missing or stale.

    Parameters
    ----------
    scenario : Scenario
        Gives their size and, to native ones, the parameters that the modes depend on.
    fmus : str
        Which build: ``python`` or ``native``.
    contact : {"vehicle", "track"}
        Which of the two FMUs has the contacts.
    directory : Path, optional
        Where the FMUs are kept; `fmu_src.building.folder_of` without.
    fmi_version : {2, 3}
        Version of FMI of native FMUs.
    platforms : collection of str, optional
        What native FMUs are compiled for; this machine without.
    notify : callable, optional
        Told in a few words what is built.

    Raises
    ------
    InputError
        For a build that there is not.
    BuildError
        Where they cannot be compiled or written.
    RunError
        Where the modes of a native track cannot be found.
    """
    structure = _structure(scenario)
    directory = directory or folder_of(fmus)
    try:
        if fmus == "python":
            return ensure_fmus(directory, structure, contact=contact, progress=notify)
        if fmus != "native":
            raise InputError(f"fmus is {fmus!r} but must be python or native")
        return ensure_native_fmus(
            directory,
            structure,
            contact=contact,
            fixed=track_constants(scenario),
            fmi_version=fmi_version,
            platforms=platforms,
            progress=notify,
        )
    except CompilationError as error:
        raise BuildError(f"{error}; or run with --fmus python") from error
    except (EigenvalueError, LinAlgError) as error:
        raise RunError(
            f"the modes of the track cannot be found ({error}); check the keys of [track]"
        ) from error
    except OSError as error:
        raise BuildError(
            f"the FMUs cannot be written to {directory}: {error.strerror or error}; make that "
            "folder writable"
        ) from error


def has_own_fmu(scenario: Scenario, fmus: str) -> bool:
    """Tell whether the track has an FMU of its own, of which only the last few built are kept.

    Native ones of other constants than the paper's do.
    """
    if fmus != "native":
        return False
    size = _structure(scenario)
    track = native_track(
        bays=size.bays,
        elements_per_bay=size.elements_per_bay,
        wheels=size.wheels,
        gauges=size.gauges,
        fixed=track_constants(scenario),
    )
    return not track.usual


def _structure(scenario: Scenario) -> Structure:
    numbers = count(scenario)
    return Structure(
        bays=scenario.track.bays,
        elements_per_bay=scenario.track.elements_per_bay,
        wheels=numbers["wheel"],
        gauges=numbers["gauge"],
        bogies=scenario.vehicle.bogies,
    )
