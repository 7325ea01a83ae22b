"""Contact on the track's side: numpy models as the Python FMUs make them, and native twins."""

from typing import ClassVar

import numpy as np

from fmu_src.python.masses_slave import MassesSlave
from fmu_src.python.track_contact_slave import TrackContactSlave

from .library import HELD, STRAIGHT
from .twins import (
    TRACK_GROUPS,
    body_outputs,
    coordinates,
    filled,
    native_track_state,
    put_dynamic,
)

CONTACT_GROUPS = (
    "contact_force",
    "contact_force_ahead",
    "gap",
    "static_displacement",
    "static_velocity",
    "mean_velocity",
)
MASSES_GROUPS = ("position", "displacement", "velocity", "load_change")
MODE_PAIRS = 36
RATES = {"force_rate": "force_change", "increment_rate": "force_change"}


class ContactPair:
    """Both tracks with contacts."""

    def __init__(
        self, native, parameters, resource=None, *, wheels=2, gauges=2, pairs=MODE_PAIRS, values=()
    ):
        class Slave(TrackContactSlave):
            bays: ClassVar[int] = parameters.bays
            elements_per_bay: ClassVar[int] = parameters.elements_per_bay

        Slave.wheels, Slave.gauges = wheels, gauges
        self.native = native("track_contact", resource)
        for name, value in dict(values).items():
            self.native.set_one(name, value)
        slave = Slave(instance_name="twin")
        self.numpy = slave.make_model(slave._parameters | {"mode_pairs": pairs} | dict(values))
        self.wheels, self.supports = wheels, parameters.supports
        self.last_step = 1e-4

    def start(self, positions, displacements):
        self.native.enter()
        self.set(positions, displacements)
        self.native.exit()
        self.numpy.start(positions, displacements)

    def set(self, positions, displacements):
        self.native.set_group("wheel[#].position", positions)
        self.native.set_group("wheel[#].displacement", displacements)

    def step(self, step_size, positions, displacements, *, linear):
        """Both; the numpy one first, whose errors are raised."""
        self.set(positions, displacements)
        self.last_step = step_size
        self.numpy.step(step_size, positions, displacements, linear=linear)
        self.native_step(step_size, linear=linear)

    def native_step(self, step_size, *, linear):
        self.native.step(self.native.time, step_size, STRAIGHT if linear else HELD)

    def outputs(self):
        """Name, numpy's and the native values of all outputs."""
        seen = self.numpy.observe()
        for name in CONTACT_GROUPS:
            label = "contact_force" if name == "contact_force_ahead" else name
            yield label, getattr(self.numpy, name), self.native.group(f"wheel[#].{name}")
        yield "in_contact", self.numpy.in_contact, self.native.group("wheel[#].in_contact")
        for name, group in TRACK_GROUPS.items():
            model = self.numpy if name == "rail_displacement" else seen
            yield name, getattr(model, name), self.native.group(group)

    def copy_state(self, flat):
        """Set a flat state of the numpy model in both."""
        self.numpy.state = flat
        own = self._to_native(flat)
        block = self.native.state
        block[-len(own) :] = own
        self.native.state = block

    def states(self):
        """Numpy's state as the native one has it, and the native one; names and values."""
        wheels = self.wheels
        lengths = {"position": wheels, "speed": wheels, "force": wheels, "force_rate": wheels,
                   "displacement": wheels, "increment": 2 * self.supports,
                   "increment_rate": 2 * self.supports, "pads": 3 * self.supports,
                   "modal": 2 * filled(self.modes),
                   "load": 2 * filled(self.modes), "offset": 1, "compression": wheels,
                   "ahead": wheels,
                   "origin": wheels, "velocity": wheels, "mean_velocity": wheels,
                   "history": 6 * wheels, "ages": 2, "passed": 1}  # fmt: skip
        own = self._to_native(self.numpy.state)
        places = np.cumsum(list(lengths.values()))[:-1]
        expected, found = np.split(own, places), np.split(self.native.state[-len(own) :], places)
        for name, mine, other in zip(lengths, expected, found, strict=True):
            if name in RATES:  # of forces that are known to 1e-8 N, over the step
                yield RATES[name], mine * self.last_step, other * self.last_step
            else:
                yield name, mine, other

    @property
    def modes(self):
        return len(self.numpy._track.track.eigenvalues)

    @property
    def own_size(self):
        """Numbers of a state behind those of the track."""
        return 11 * self.wheels + 3

    def _to_native(self, flat):
        track, own = np.split(flat, [len(flat) - self.own_size])
        sizes = {"wheels": self.wheels, "supports": self.supports, "modes": self.modes}
        return np.concatenate([native_track_state(track, **sizes), own])


class MassesPair:
    """Both masses."""

    def __init__(self, native, resource=None, *, wheels=2, bogies=1, values=()):
        class Slave(MassesSlave):
            pass

        Slave.wheels, Slave.bogies = wheels, bogies
        self.wheels, self.bogies = wheels, bogies
        self.native = native("masses", resource)
        for name, value in dict(values).items():
            self.native.set_one(name, value)
        self.slave = slave = Slave(instance_name="twin")
        self.numpy = slave.make_model(slave._parameters | dict(values))

    def start(self, time, forces, standing=None):
        self.native.enter(time)
        self.native.set_group("wheel[#].contact_force", forces)
        if standing is not None:
            self.native.set_group("wheel[#].static_displacement", standing.displacement)
            self.native.set_group("wheel[#].static_velocity", standing.velocity)
            self.native.set_group("wheel[#].mean_velocity", standing.mean_velocity)
        self.native.exit()
        self.numpy.initialise(time, forces, standing)

    def step(self, step_size, forces, *, linear):
        self.native.set_group("wheel[#].contact_force", forces)
        time = self.native.time
        self.native.step(time, step_size, STRAIGHT if linear else HELD)
        self.numpy.step(time, step_size, forces, linear=linear)

    def copy_state(self, state):
        self.numpy.state = state
        put_dynamic(self.native, self.dynamic_size, state)

    @property
    def dynamic_size(self):
        return 3 + 4 * self.wheels + 4 * coordinates(self)

    @property
    def dynamic(self):
        """The native dynamic values that the numpy model has as well."""
        return self.native.state[-self.dynamic_size :][: len(self.numpy.state)]

    def outputs(self):
        for name in MASSES_GROUPS:
            yield name, getattr(self.numpy, name), self.native.group(f"wheel[#].{name}")
        yield from body_outputs(self)
