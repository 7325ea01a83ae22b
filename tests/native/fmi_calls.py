"""An instance of a native FMU through ctypes, of either version of FMI, with its log."""

import ctypes
from ctypes import c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path

import fmpy
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2StepFinishedTYPE,
)
from fmpy.fmi3 import fmi3IntermediateUpdateCallback, fmi3LogMessageCallback

OK, WARNING, DISCARD, ERROR = range(4)


def references(numbers):
    return (c_uint32 * len(numbers))(*numbers)


class Calls:
    """What both versions have in common; functions are called by their names without prefix."""

    def __init__(
        self, folder, *, logging=True, early_return=False, build=None, resources=None, update=None
    ):
        self.folder = Path(folder)
        self.description = fmpy.read_model_description(str(folder))
        self.version = 2 if self.description.fmiVersion == "2.0" else 3
        self.number = {v.name: v.valueReference for v in self.description.modelVariables}
        name = self.description.coSimulation.modelIdentifier + fmpy.sharedLibraryExtension
        platform = fmpy.platform if self.version == 2 else fmpy.platform_tuple
        self.library = ctypes.CDLL(str(self.folder / "binaries" / platform / name))
        self.messages = []
        token = self.token if build is None else build
        resources = self.folder / "resources" if resources is None else resources
        self.update = fmi3IntermediateUpdateCallback(update) if update else None
        make = self._instantiate_2 if self.version == 2 else self._instantiate_3
        self.handle = make(token.encode(), Path(resources), logging, early_return)

    @property
    def token(self):
        return self.description.guid or self.description.instantiationToken

    def _instantiate_2(self, token, resources, logging, _):
        def log(_environment, _name, _status, category, message):
            self.messages.append((category.decode(), message.decode(errors="replace")))

        self.callbacks = fmi2CallbackFunctions(
            logger=fmi2CallbackLoggerTYPE(log),
            allocateMemory=fmi2CallbackAllocateMemoryTYPE(),
            freeMemory=fmi2CallbackFreeMemoryTYPE(),
            stepFinished=fmi2StepFinishedTYPE(),
        )
        return self.function("Instantiate", c_void_p)(
            b"one",
            c_int(1),
            token,
            resources.as_uri().encode(),
            ctypes.byref(self.callbacks),
            c_int(0),
            c_int(logging),
        )

    def _instantiate_3(self, token, resources, logging, early_return):
        def log(_environment, _status, category, message):
            self.messages.append((category.decode(), message.decode(errors="replace")))

        self.callback = fmi3LogMessageCallback(log)
        return self.function("InstantiateCoSimulation", c_void_p)(
            b"one",
            token,
            f"{resources}/".encode(),
            *(c_bool(flag) for flag in (False, logging, False, early_return)),
            None,
            c_size_t(0),
            None,
            self.callback,
            self.update,
        )

    def function(self, name, result=c_int):
        found = getattr(self.library, f"fmi{self.version}{name}")
        found.restype = result
        return found

    def call(self, name, *arguments):
        """Status of a call; the instance comes first by itself."""
        if self.version == 3:
            name = name.replace("FMUstate", "FMUState").replace("DeSerial", "Deserial")
        return self.function(name)(c_void_p(self.handle), *arguments)

    @property
    def message(self):
        return self.messages[-1][1]

    def must(self, status):
        assert status == OK, self.messages

    def start(self, time=0.0, **values):
        """Set values, __ for a dot, and go through the initialisation."""
        for name, value in values.items():
            self.must(self.put(name.replace("__", "."), value))
        if self.version == 2:
            self.must(self.setup(time))
            self.must(self.call("EnterInitializationMode"))
        else:
            self.must(self.setup(time))
        self.must(self.call("ExitInitializationMode"))
        return self

    def setup(self, start, stop=None):
        flags = (c_int, c_int) if self.version == 2 else (c_bool, c_bool)
        name = "SetupExperiment" if self.version == 2 else "EnterInitializationMode"
        return self.call(
            name,
            flags[0](0),
            c_double(0.0),
            c_double(start),
            flags[1](stop is not None),
            c_double(stop or 0.0),
        )

    def put(self, name, value):
        boolean = c_int if self.version == 2 else c_bool
        integer, real = ("Integer", "Real") if self.version == 2 else ("Int32", "Float64")
        kind, holder = {
            bool: ("Boolean", boolean),
            int: (integer, c_int),
            float: (real, c_double),
            str: ("String", c_char_p),
        }[type(value)]
        data = (holder * 1)(value.encode() if isinstance(value, str) else value)
        return self.call(
            f"Set{kind}", references([self.number[name]]), c_size_t(1), data, *self.n(1)
        )

    def n(self, count):
        """The second count, which FMI 3.0 alone has."""
        return (c_size_t(count),) if self.version == 3 else ()

    def get(self, *names):
        values = (c_double * len(names))()
        kind = "Real" if self.version == 2 else "Float64"
        numbers = references([self.number[name] for name in names])
        self.must(
            self.call(f"Get{kind}", numbers, c_size_t(len(names)), values, *self.n(len(names)))
        )
        return list(values)

    def step(self, time, size):
        """Status of a step, and the last successful time."""
        reached = c_double(-1.0)
        if self.version == 2:
            status = self.call("DoStep", c_double(time), c_double(size), c_int(0))
            self.must(self.call("GetRealStatus", c_int(2), ctypes.byref(reached)))
            return status, reached.value
        flags = [c_bool() for _ in range(3)]
        status = self.call(
            "DoStep",
            c_double(time),
            c_double(size),
            c_bool(False),
            *(ctypes.byref(flag) for flag in flags),
            ctypes.byref(reached),
        )
        self.early = flags[2].value
        return status, reached.value

    def save(self):
        state = c_void_p()
        self.must(self.call("GetFMUstate", ctypes.byref(state)))
        return state

    def serialise(self, state):
        size = c_size_t()
        self.must(self.call("SerializedFMUstateSize", state, ctypes.byref(size)))
        data = ctypes.create_string_buffer(size.value)
        self.must(self.call("SerializeFMUstate", state, data, size))
        return data.raw

    def deserialise(self, data):
        state = c_void_p()
        buffer = ctypes.create_string_buffer(data, max(len(data), 1))
        status = self.call("DeSerializeFMUstate", buffer, c_size_t(len(data)), ctypes.byref(state))
        return status, state

    def sensitivity(self, unknowns, knowns, seed, *, adjoint=False):
        result = (c_double * len(knowns if adjoint else unknowns))()
        status = self.call(
            "GetAdjointDerivative" if adjoint else "GetDirectionalDerivative",
            references([self.number[name] for name in unknowns]),
            c_size_t(len(unknowns)),
            references([self.number[name] for name in knowns]),
            c_size_t(len(knowns)),
            (c_double * len(seed))(*seed),
            *self.n(len(seed)),
            result,
            *self.n(len(result)),
        )
        return status, list(result)

    def free(self):
        if self.handle:
            self.function("FreeInstance", None)(c_void_p(self.handle))
            self.handle = None
