"""One instance of an FMU in memory: unpacked, loaded, instantiated, freed."""

from abc import ABC, abstractmethod
from contextlib import chdir
from ctypes import c_void_p
from tempfile import TemporaryDirectory
from typing import Any, ClassVar

import fmpy

from ..participant import Status, StatusKind
from .description import FmuDescription
from .log import FmuLog
from .states import StateFunctions
from .values import FmiFunctions

kinds = {2: StatusKind.DISCARD, 3: StatusKind.ERROR, 4: StatusKind.FATAL}
labels = {2: "Discard", 3: "Error", 4: "Fatal", 5: "Pending, which is not supported"}


Call = tuple[str, tuple[object, ...]]
"""A function of FMI and its arguments after the instance."""


class FmuInstance(ABC):
    """An instance in a temporary folder of its own; each version of FMI has its kind.

    Parameters
    ----------
    description : FmuDescription
        The FMU.
    name : str
        Name of the instance.
    log : FmuLog
        Keeps its messages.

    Attributes
    ----------
    functions : mapping of str to callable
        Raw functions of the shared library.
    component : ctypes.c_void_p
        The instance as these functions take it.
    dead : bool
        Set after fmi2Fatal or fmi3Fatal: then nothing may be called any more.
    prefix : str
        What the names of functions and statuses begin with.
    state_functions : StateFunctions
        Names of the functions for states.

    Raises
    ------
    OSError
        When the FMU cannot be unpacked, loaded or instantiated.
    """

    prefix: ClassVar[str]
    state_functions: ClassVar[StateFunctions]

    def __init__(self, description: FmuDescription, name: str, log: FmuLog) -> None:
        self.dead = False
        self._folder = TemporaryDirectory(prefix="fmu-", ignore_cleanup_errors=True)
        self._slave: Any = None
        try:
            fmpy.extract(description.path, self._folder.name)
            with chdir("."):  # fmpy stays in the library's folder when loading it fails
                self._slave = self._load(
                    guid=description.guid,
                    unzipDirectory=self._folder.name,
                    modelIdentifier=description.model_identifier,
                    instanceName=name,
                )
            self._start(description, log)
        except Exception as error:
            self.free()
            # fmpy raises plain Exception, or AttributeError for a function that is missing.
            raise OSError(str(error)) from error
        self.functions: FmiFunctions = self._slave._functions  # noqa: SLF001 - the unwrapped calls
        self.component = c_void_p(self._slave.component)

    @abstractmethod
    def _load(self, **arguments: str) -> Any:  # noqa: ANN401 - fmpy carries no types
        """Load the shared library."""

    @abstractmethod
    def _start(self, description: FmuDescription, log: FmuLog) -> None:
        """Create the instance; without logging switched on, some do not even say why they fail."""

    @abstractmethod
    def opening(self, start: float, stop: float, tolerance: float | None) -> list[Call]:
        """Return the calls that begin the initialisation, times in s."""

    @abstractmethod
    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""

    def answer(self, what: str, status: int) -> Status:
        """Return the meaning of an FMI status above a warning that `what` ended with."""
        kind = kinds.get(status, StatusKind.ERROR)
        self.dead = self.dead or kind is StatusKind.FATAL
        label = labels.get(status)
        end = f"unknown status {status}" if label is None else self.prefix + label
        return Status(kind, f"{what} ended with {end}")

    def free(self) -> None:
        """Free instance, library and folder; harmless when repeated.

        A dead instance is not even freed: instance and library stay in memory until the process
        ends.
        """
        slave, self._slave = self._slave, None
        if slave is not None and not self.dead:
            if slave.component is not None:
                slave.freeInstance()
            else:
                slave.freeLibrary()
        self._folder.cleanup()


def asks_for_the_end(reached: float) -> Status:
    """Return the answer of an FMU that wants no more steps after the time `reached` [s]."""
    return Status(
        StatusKind.FATAL, f"the step asked for the end of the simulation at {reached:.9g} s"
    )
