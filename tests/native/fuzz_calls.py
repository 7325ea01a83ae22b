"""Random calls of the functions of a native FMU, in any order and with any arguments.

``python fuzz_calls.py FOLDER SEED CALLS`` ends with 0 if no call crashed and every one of them
answered with a status of the standard. Arrays are as long as the counts say: what a host lies about
there, no FMU can know.
"""

import ctypes
import random
import sys
from collections import Counter
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_void_p
from pathlib import Path

if __package__ in {None, ""}:
    sys.path.insert(0, str(Path(__file__).parents[2]))
    from tests.native.fmi_calls import DISCARD, ERROR, OK, Calls, references
else:
    from .fmi_calls import DISCARD, ERROR, OK, Calls, references

NUMBERS = (0.0, 1.0, -1.0, 4.0, 1e5, 1e-3, 1e300, -1e300, 1e-300, float("nan"), float("inf"))
TIMES = (0.0, 1e-5, 1e-4, 1e-3, 0.1, -1e-4, 1e9, float("nan"), float("inf"))
TEXTS = (
    b"",
    b"linear",
    b"haversine",
    b"none",
    b"nowhere.csv",
    b"%s%n",
    b"x" * 2000,
    b"\xff\xfe",
    None,
)


class Fuzz:
    """One FMU, its instances and its states."""

    def __init__(self, folder, seed):
        self.random = random.Random(seed)  # noqa: S311 - not for secrets
        self.folder = folder
        self.states = []
        self.bytes = [b"", b"RCFM", bytes(100)]
        self.answers = Counter()
        self.new_instance()

    def new_instance(self):
        choice = self.random.random
        self.now = Calls(self.folder, logging=choice() < 0.5, early_return=choice() < 0.5)
        self.time = 0.0

    def pick(self, *values):
        return self.random.choice(values)

    def some_references(self):
        count = self.pick(0, 1, 1, 1, 2, 5)
        last = len(self.now.number)
        numbers = [
            self.pick(self.random.randrange(last), self.random.randrange(last), 2**32 - 1)
            for _ in range(count)
        ]
        return self.pick(*[references(numbers)] * 9, None) if count else None, count

    def call(self, name, *arguments):
        status = self.now.call(name, *arguments)
        assert status in {OK, DISCARD, ERROR}, (name, status)
        self.answers[name, status] += 1
        return status

    def values(self):
        version = self.now.version
        kinds = {
            2: {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": c_char_p},
            3: {
                "Float64": c_double,
                "Int32": c_int,
                "Boolean": c_bool,
                "String": c_char_p,
                "Int8": ctypes.c_int8,
                "UInt64": ctypes.c_uint64,
                "Float32": ctypes.c_float,
            },
        }[version]
        kind = self.pick(*kinds)
        numbers, count = self.some_references()
        holder = kinds[kind]
        data = (holder * max(count, 1))()
        for place in range(count):
            data[place] = {
                c_double: self.pick(*NUMBERS),
                ctypes.c_float: 1.0,
                c_char_p: self.pick(*TEXTS),
            }.get(holder, self.pick(0, 1, 2))
        how = self.pick("Get", "Set")
        second = self.now.n(self.pick(count, count, count, count + 1))
        self.call(
            f"{how}{kind}", numbers, c_size_t(count), self.pick(data, data, data, None), *second
        )

    def life(self):
        flag = c_int if self.now.version == 2 else c_bool
        start, stop = self.pick(*TIMES), self.pick(*TIMES)
        name = self.pick("EnterInitializationMode", "ExitInitializationMode", "Terminate", "Reset")
        experiment = (
            flag(1), c_double(1.0), c_double(start), flag(self.pick(0, 1)), c_double(stop),
        )  # fmt: skip
        if self.now.version == 3 and name == "EnterInitializationMode":
            self.call(name, *experiment)
        else:
            if self.now.version == 2:
                self.call("SetupExperiment", *experiment)
            self.call(name)
        self.time = start if name == "EnterInitializationMode" else self.time

    def steps(self):
        size = self.pick(*TIMES[:5], *TIMES)
        if self.pick(0, 0, 1):
            self.time = self.pick(*TIMES)
        if size > 0.1 and size < 1e10:
            size = 0.1
        status, reached = self.now.step(self.time, size)
        self.answers["DoStep", status] += 1
        self.time = reached

    def save(self):
        state = c_void_p(self.pick(None, None, *[item.value for item in self.states]))
        if self.call("GetFMUstate", byref(state)) == OK and all(
            item.value != state.value for item in self.states
        ):
            self.states.append(state)

    def a_state(self):
        return self.pick(c_void_p(), *self.states)

    def restore(self):
        self.call("SetFMUstate", self.a_state())

    def forget(self):
        state = self.a_state()
        if self.call("FreeFMUstate", byref(state)) == OK and state in self.states:
            self.states.remove(state)

    def serialise(self):
        size, state = c_size_t(), self.a_state()
        if self.call("SerializedFMUstateSize", state, byref(size)) != OK:
            return
        room = self.pick(size.value, size.value, size.value // 2)
        data = ctypes.create_string_buffer(max(room, 1))
        if self.call("SerializeFMUstate", state, data, c_size_t(room)) == OK:
            self.bytes = [*self.bytes[:3], data.raw]

    def deserialise(self):
        data = bytearray(self.pick(*self.bytes))
        if data and self.pick(0, 1):
            data[self.random.randrange(len(data))] ^= self.pick(1, 16, 128)
            data = data[: self.pick(len(data), self.random.randrange(len(data) + 1))]
        status, state = self.now.deserialise(bytes(data))
        self.answers["DeSerializeFMUstate", status] += 1
        if status == OK:
            self.states.append(state)

    def derivatives(self):
        (unknowns, n), (knowns, m) = self.some_references(), self.some_references()
        adjoint = self.now.version == 3 and self.pick(0, 1)
        seeds, results = (n, m) if adjoint else (m, n)
        self.call(
            "GetAdjointDerivative" if adjoint else "GetDirectionalDerivative",
            unknowns, c_size_t(n), knowns, c_size_t(m),
            (c_double * max(seeds, 1))(*[self.pick(*NUMBERS) for _ in range(seeds)]),
            *self.now.n(seeds),
            (c_double * max(results, 1))(),
            *self.now.n(results),
        )  # fmt: skip

    def slopes(self):
        numbers, n = self.some_references()
        orders = (c_int * max(n, 1))(*[self.pick(1, 1, 1, 0, 2, -1) for _ in range(n)])
        values = (c_double * max(n, 1))(*[self.pick(*NUMBERS) for _ in range(n)])
        names = {
            2: ("SetRealInputDerivatives", "GetRealOutputDerivatives"),
            3: ("GetOutputDerivatives",),
        }[self.now.version]
        self.call(self.pick(*names), numbers, c_size_t(n), orders, values, *self.now.n(n))

    def oddities(self):
        names = {
            2: ("CancelStep",),
            3: ("EnterEventMode", "EnterStepMode", "ExitConfigurationMode"),
        }[self.now.version]
        flag = c_int if self.now.version == 2 else c_bool
        if self.pick(0, 1):
            self.call(self.pick(*names))
        categories = (c_char_p * 2)(b"logStatusError", self.pick(b"logStatusDiscard", None, b"?"))
        self.call("SetDebugLogging", flag(1), c_size_t(self.pick(0, 1, 2)), categories)
        if self.now.version == 2:
            kind = self.pick("Status", "RealStatus", "IntegerStatus", "BooleanStatus")
            place = (c_double * 1)()
            self.call(f"Get{kind}", c_int(self.pick(0, 1, 2, 3, 77)), self.pick(place, None))

    def fresh(self):
        """Another instance, in its initialisation or beyond, with inputs that can be."""
        for state in self.states:
            self.call("FreeFMUstate", byref(state))
        self.states.clear()
        self.now.free()
        self.new_instance()
        if self.pick(0, 1, 1):
            self.now.start()

    def run(self, calls):
        """Make so many calls, those by the book more often."""
        kinds = [
            *[self.values] * 8, *[self.steps] * 10, *[self.life] * 2, *[self.save] * 4,
            *[self.restore] * 4, self.forget, self.serialise, *[self.deserialise] * 2,
            *[self.derivatives] * 4, *[self.slopes] * 4, self.oddities,
        ]  # fmt: skip
        count = 0
        while sum(self.answers.values()) < calls:
            count += 1
            self.now.messages.clear()
            if count % 40 == 0:
                self.fresh()
            self.random.choice(kinds)()
        self.fresh()
        self.now.free()


if __name__ == "__main__":
    fuzz = Fuzz(sys.argv[1], int(sys.argv[2]))
    fuzz.run(int(sys.argv[3]))
    answered = Counter()
    for (_, answer), count in fuzz.answers.items():
        answered[answer] += count
    print(*(answered[status] for status in (OK, DISCARD, ERROR)))  # noqa: T201 - read by the test
