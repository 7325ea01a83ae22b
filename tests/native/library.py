"""The native models through ctypes: the interface of model.h, one method a function."""

import ctypes
from ctypes import c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p

import numpy as np

OK, DISCARD, ERROR = range(3)
REAL, INTEGER, BOOLEAN, TEXT = range(4)
CONSTANT, PARAMETER, INPUT, OUTPUT = range(4)
AS_PARAMETER, HELD, STRAIGHT = range(3)
MESSAGE_SIZE = 2048
TYPES = {float: REAL, int: INTEGER, bool: BOOLEAN, str: TEXT}


class Group(ctypes.Structure):
    _fields_ = (
        ("name", c_char_p),
        ("type", c_int),
        ("causality", c_int),
        ("first", c_uint32),
        ("count", c_uint32),
        ("lowest", c_uint32),
    )


SIGNATURES = {
    "rc_library_class": (c_void_p, []),
    "rc_create": (c_void_p, [c_void_p, c_void_p, c_size_t, c_char_p]),
    "rc_destroy": (None, [c_void_p]),
    "rc_reset": (None, [c_void_p]),
    "rc_message": (c_char_p, [c_void_p]),
    "rc_warning": (c_char_p, [c_void_p]),
    "rc_current_phase": (c_int, [c_void_p]),
    "rc_time": (c_double, [c_void_p]),
    "rc_variable_count": (c_uint32, [c_void_p]),
    "rc_group_count": (c_size_t, [c_void_p]),
    "rc_group_at": (ctypes.POINTER(Group), [c_void_p, c_size_t]),
    "rc_name": (c_size_t, [c_void_p, c_uint32, c_char_p, c_size_t]),
    "rc_get": (c_int, [c_void_p, c_int, c_void_p, c_size_t, c_void_p]),
    "rc_set": (c_int, [c_void_p, c_int, c_void_p, c_size_t, c_void_p]),
    "rc_get_text": (c_int, [c_void_p, c_uint32, ctypes.POINTER(c_char_p)]),
    "rc_set_text": (c_int, [c_void_p, c_uint32, c_char_p]),
    "rc_get_group": (c_int, [c_void_p, c_size_t, c_void_p]),
    "rc_set_group": (c_int, [c_void_p, c_size_t, c_void_p]),
    "rc_enter_initialisation": (c_int, [c_void_p, c_double]),
    "rc_exit_initialisation": (c_int, [c_void_p]),
    "rc_step": (c_int, [c_void_p, c_double, c_double, c_int, c_void_p]),
    "rc_jump": (c_int, [c_void_p]),
    "rc_state_size": (c_size_t, [c_void_p]),
    "rc_save": (None, [c_void_p, c_void_p]),
    "rc_restore": (c_int, [c_void_p, c_void_p]),
    "rc_serialised_size": (c_size_t, [c_void_p]),
    "rc_serialise": (None, [c_void_p, c_void_p, c_void_p]),
    "rc_deserialise": (c_int, [c_void_p, c_void_p, c_size_t, c_void_p]),
    "rc_derivative": (
        c_int,
        [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p],
    ),
}


class NativeError(Exception):
    """A call that failed, with its sentence."""


class DiscardedError(NativeError):
    """A step that was refused."""


def load(path):
    """Load a library with the types of its functions."""
    library = ctypes.CDLL(str(path))
    for name, (result, arguments) in SIGNATURES.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


def aligned(data):
    """The bytes at an address that is a multiple of 8."""
    place = np.zeros(-(-len(data) // 8) + 1, dtype=np.float64)
    ctypes.memmove(place.ctypes.data, data, len(data))
    return place


def create(library, data, size):
    """Handle of an instance; NativeError with the sentence if there is none."""
    message = ctypes.create_string_buffer(MESSAGE_SIZE)
    handle = library.rc_create(library.rc_library_class(), data.ctypes.data, size, message)
    if not handle:
        raise NativeError(message.value.decode())
    return handle


class NativeModel:
    """An instance of a native model."""

    def __init__(self, library, resource):
        self.library = library
        self._data = aligned(resource)
        self.handle = create(library, self._data, len(resource))
        self.names = [self._name(i) for i in range(library.rc_variable_count(self.handle))]
        self.number = {name: i for i, name in enumerate(self.names)}
        self.groups = [
            library.rc_group_at(self.handle, g).contents
            for g in range(library.rc_group_count(self.handle))
        ]
        self.place = {group.name.decode(): g for g, group in enumerate(self.groups)}
        self.state_size = library.rc_state_size(self.handle)
        self._reached = c_double()

    def close(self):
        self.library.rc_destroy(self.handle)

    @property
    def message(self):
        return self.library.rc_message(self.handle).decode()

    @property
    def warning(self):
        return self.library.rc_warning(self.handle).decode()

    @property
    def time(self):
        return self.library.rc_time(self.handle)

    def set(self, **values):
        """Set variables by name; __ stands for a dot."""
        for name, value in values.items():
            self.set_one(name.replace("__", "."), value)

    def set_one(self, name, value):
        number = self.number[name]
        if isinstance(value, str):
            self._check(self.library.rc_set_text(self.handle, number, value.encode()))
            return
        kind = TYPES[type(value)]
        one, values = np.array([number], dtype=np.uint32), np.array([float(value)])
        status = self.library.rc_set(self.handle, kind, one.ctypes.data, 1, values.ctypes.data)
        self._check(status)

    def text(self, name):
        text = c_char_p()
        self._check(self.library.rc_get_text(self.handle, self.number[name], ctypes.byref(text)))
        return text.value.decode()

    def get(self, names, kind=REAL):
        numbers = np.array([self.number[name] for name in names], dtype=np.uint32)
        values = np.empty(len(numbers))
        status = self.library.rc_get(
            self.handle, kind, numbers.ctypes.data, len(numbers), values.ctypes.data
        )
        self._check(status)
        return values

    def group(self, name):
        """All values of a group."""
        number = self.place[name]
        values = np.empty(self.groups[number].count)
        status = self.library.rc_get_group(self.handle, number, values.ctypes.data)
        self._check(status)
        return values

    def set_group(self, name, values):
        values = np.ascontiguousarray(values, dtype=np.float64)
        number = self.place[name]
        assert values.shape == (self.groups[number].count,)
        self._check(self.library.rc_set_group(self.handle, number, values.ctypes.data))

    def enter(self, time=0.0):
        self._check(self.library.rc_enter_initialisation(self.handle, time))

    def exit(self):
        self._check(self.library.rc_exit_initialisation(self.handle))

    def step(self, time, step_size, shape=AS_PARAMETER):
        """Step, and return the last successful time."""
        reached = ctypes.byref(self._reached)
        self._check(self.library.rc_step(self.handle, time, step_size, shape, reached))
        return self._reached.value

    def jump(self):
        self._check(self.library.rc_jump(self.handle))

    @property
    def reached(self):
        return self._reached.value

    @property
    def state(self):
        """The state as a block of float64."""
        block = np.empty(self.state_size // 8)
        self.library.rc_save(self.handle, block.ctypes.data)
        return block

    @state.setter
    def state(self, block):
        self._check(self.library.rc_restore(self.handle, block.ctypes.data))

    def serialise(self, block):
        data = ctypes.create_string_buffer(self.library.rc_serialised_size(self.handle))
        self.library.rc_serialise(self.handle, block.ctypes.data, data)
        return data.raw

    def deserialise(self, data):
        block = np.empty(self.state_size // 8)
        buffer = ctypes.create_string_buffer(data, len(data))
        status = self.library.rc_deserialise(self.handle, buffer, len(data), block.ctypes.data)
        self._check(status)
        return block

    def derivative(self, unknowns, knowns, seed):
        to = np.array([self.number[name] for name in unknowns], dtype=np.uint32)
        by = np.array([self.number[name] for name in knowns], dtype=np.uint32)
        seed, change = np.array(seed, dtype=np.float64), np.empty(len(to))
        status = self.library.rc_derivative(
            self.handle, to.ctypes.data, len(to), by.ctypes.data, len(by),
            seed.ctypes.data, change.ctypes.data,
        )  # fmt: skip
        self._check(status)
        return change

    def _name(self, number):
        name = ctypes.create_string_buffer(100)
        assert self.library.rc_name(self.handle, number, name, len(name)) > 0
        return name.value.decode()

    def _check(self, status):
        if status == DISCARD:
            raise DiscardedError(self.message)
        if status != OK:
            raise NativeError(self.message)
