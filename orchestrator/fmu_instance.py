"""One instance of an FMU in memory: unpacked, loaded, instantiated, freed."""

from contextlib import chdir
from ctypes import c_void_p
from tempfile import TemporaryDirectory

import fmpy
from fmpy.fmi2 import FMU2Slave

from .fmu_description import FmuDescription
from .fmu_log import FmuLog
from .fmu_values import FmiFunctions
from .participant import Status, StatusKind

kinds = {2: StatusKind.DISCARD, 3: StatusKind.ERROR, 4: StatusKind.FATAL, 5: StatusKind.ERROR}
labels = {
    2: "fmi2Discard",
    3: "fmi2Error",
    4: "fmi2Fatal",
    5: "fmi2Pending, which is not supported",
}


class FmuInstance:
    """An instance in a temporary folder of its own.

    Parameters
    ----------
    description : FmuDescription
        The FMU.
    name : str
        Name of the instance.
    log : FmuLog
        Keeps its messages; it must live as long as the instance.

    Attributes
    ----------
    functions : mapping of str to callable
        Raw functions of the shared library.
    component : ctypes.c_void_p
        The instance as these functions take it.
    dead : bool
        Set after fmi2Fatal: then nothing may be called any more.

    Raises
    ------
    OSError
        When the FMU cannot be unpacked, loaded or instantiated.
    """

    def __init__(self, description: FmuDescription, name: str, log: FmuLog) -> None:
        self.dead = False
        self._folder = TemporaryDirectory(prefix="fmu-", ignore_cleanup_errors=True)
        self._slave: FMU2Slave | None = None
        try:
            fmpy.extract(description.path, self._folder.name)
            with chdir("."):  # fmpy stays in the library's folder when loading it fails
                self._slave = FMU2Slave(
                    guid=description.guid,
                    unzipDirectory=self._folder.name,
                    modelIdentifier=description.model_identifier,
                    instanceName=name,
                )
            # Without logging switched on, some FMUs do not even say why they fail.
            self._slave.instantiate(callbacks=log.callbacks, loggingOn=True)
        except Exception as error:
            self.free()
            # fmpy raises plain Exception, or AttributeError for a function that is missing.
            raise OSError(str(error)) from error
        self.functions: FmiFunctions = self._slave._functions  # noqa: SLF001 - the unwrapped calls
        self.component = c_void_p(self._slave.component)

    def answer(self, what: str, status: int) -> Status:
        """Return the meaning of an FMI status above fmi2Warning that `what` ended with."""
        kind = kinds.get(status, StatusKind.ERROR)
        self.dead = self.dead or kind is StatusKind.FATAL
        return Status(kind, f"{what} ended with {labels.get(status, f'unknown status {status}')}")

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
