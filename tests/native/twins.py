"""A numpy model and its native twin, with the same parameters, states and inputs."""

from functools import lru_cache

import numpy as np

from fmu_src.python.basis_cache import cached_basis
from fmu_src.python.track_laws import make_laws
from fmu_src.python.track_parameters import track_parameters
from fmu_src.python.vehicle_slave import VehicleSlave
from track_fmu.assembly import assemble
from track_fmu.reduction import reduce_track
from track_fmu.track_model import TrackModel, TrackOptions

from .library import BOOLEAN, INTEGER

LANES = 8  # modes are filled up to a multiple of it
TRACK_GROUPS = {
    "rail_displacement": "wheel[#].rail_displacement",
    "rail_velocity": "wheel[#].rail_velocity",
    "wheel_moment": "wheel[#].bending_moment",
    "gauge_moment": "gauge[#].bending_moment",
    "sleeper_displacement": "sleeper[#].displacement",
    "pad_force": "pad[#].force",
    "ballast_force": "ballast[#].force",
    "sleeper_moment": "sleeper[#].bending_moment",
    "sleeper_centre_moment": "sleeper[#].centre_bending_moment",
    "window_position": "window_position",
}
VEHICLE_GROUPS = ("position", "contact_force", "displacement", "velocity", "gap")
AGREEMENT = 1e-12  # of the largest value of an array
ORDER = {
    "force": 1e5,
    "ahead": 1e5,
    "increment": 1e5,
    "compression": 1e-3,
    "rail_velocity": 0.1,
    "gap": 1e-3,
    "contact_force": 1e5,
    "force_change": 1e5,
    "velocity": 0.1,
    "displacement": 1e-4,
    "bogie_displacement": 1e-4,
    "bogie_pitch": 1e-4,
    "bogie_acceleration": 1.0,
    "car_displacement": 1e-4,
    "car_pitch": 1e-5,
    "car_acceleration": 0.1,
}
"""What differences are compared with where the values are smaller, as those of a track at rest."""


def assert_alike(rows, *, relative=AGREEMENT, parts=1):
    """Every array differs from its twin by a fraction of its largest value at most, in each part.

    A step that the models divide into parts is as many steps to them.
    """
    for name, expected, found in rows:
        assert np.isfinite(expected).all(), name
        limit = parts * relative * max(np.max(np.abs(expected)), ORDER.get(name, 0.0))
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=limit, err_msg=name)


@lru_cache(maxsize=4)
def reduced_track(parameters, mode_pairs, *, residual_flexibility=True):
    matrices = assemble(parameters)
    basis = cached_basis(parameters, matrices, mode_pairs=mode_pairs)
    return reduce_track(parameters, matrices, basis, residual_flexibility=residual_flexibility)


def filled(modes):
    return -(-modes // LANES) * LANES


def native_track_state(flat, *, wheels, supports, modes):
    """Numpy's state as C has it: modes split and filled up."""
    lengths = [5 * wheels + 7 * supports, 2 * modes, 2 * modes]
    real, modal, load, offset = np.split(flat, np.cumsum(lengths))
    rows = np.zeros((4, filled(modes)))
    rows[:, :modes] = modal[::2], modal[1::2], load[::2], load[1::2]
    return np.concatenate([real, rows.ravel(), offset])


class TrackPair:
    """Both tracks."""

    def __init__(
        self,
        native,
        parameters,
        resource=None,
        *,
        linear=True,
        speed=0.0,
        ballast="state_dependent",
        supports=6,
        gauge=None,
        values=(),
        endless=False,
    ):
        self.native = native(
            "track",
            resource,
            linear_inputs=linear,
            initial_speed=speed,
            ballast=ballast,
            supports_per_wheel=supports,
            endless=endless,
        )
        if gauge is not None:
            self.native.set_one("gauge[1].position", gauge)
        for name, value in dict(values).items():
            self.native.set_one(name, value)
        self.linear = linear
        self.parameters = parameters
        self.wheels = len(self.native.group("wheel[#].position"))
        start = {v.name: v.start for v in track_parameters(parameters, gauges=0)}
        laws = make_laws(
            parameters, start | {"ballast": ballast, "endless": endless} | dict(values)
        )
        self.reduced = reduced_track(
            parameters,
            int(self.native.get(["mode_pairs"], INTEGER)[0]),
            residual_flexibility=bool(self.native.get(["residual_flexibility"], BOOLEAN)[0]),
        )
        self.numpy = TrackModel(
            self.reduced,
            TrackOptions(
                wheels=self.wheels,
                supports_per_wheel=supports,
                initial_speed=speed,
                gauges=tuple(self.native.group("gauge[#].position")),
                endless=endless,
            ),
            ballast=laws[0],
            pad=laws[1],
        )

    def start(self, positions, forces):
        self.native.enter()
        self.set(positions, forces)
        self.native.exit()
        self.numpy.start(positions, forces)

    def step(self, step_size, positions, forces):
        self.set(positions, forces)
        self.native.step(self.native.time, step_size)
        self.numpy.step(step_size, positions, forces, linear=self.linear)

    def set(self, positions, forces):
        self.native.set_group("wheel[#].position", positions)
        self.native.set_group("wheel[#].contact_force", forces)

    def outputs(self):
        """Name, numpy's and the native values of all outputs."""
        seen = self.numpy.observe()
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
        supports = self.parameters.supports
        lengths = [self.wheels] * 5 + [2 * supports] * 2 + [supports] * 3 + [2 * self._half] * 2
        lengths.append(1)
        names = ("position", "speed", "force", "force_rate", "displacement", "increment",
                 "increment_rate", "branch_force", "compression", "known", "modal",
                 "load", "offset")  # fmt: skip
        places = np.cumsum(lengths)[:-1]
        own = self._to_native(self.numpy.state)
        expected, found = np.split(own, places), np.split(self.native.state[-len(own) :], places)
        return zip(names, expected, found, strict=True)

    @property
    def _half(self):
        return filled(len(self.reduced.eigenvalues))

    def _to_native(self, flat):
        return native_track_state(
            flat, wheels=self.wheels, supports=self.parameters.supports,
            modes=len(self.reduced.eigenvalues),
        )  # fmt: skip


class VehiclePair:
    """Both vehicles; the numpy one is made as the Python FMU makes it."""

    def __init__(self, native, resource=None, *, wheels=2, bogies=1, linear=True, values=()):
        class Slave(VehicleSlave):
            pass

        Slave.wheels, Slave.bogies = wheels, bogies
        self.linear, self.wheels, self.bogies = linear, wheels, bogies
        self.native = native("vehicle", resource, linear_inputs=linear)
        self.slave = slave = Slave(instance_name="twin")
        parameters = slave._parameters | dict(values)
        for name, value in dict(values).items():
            self.native.set_one(name, value)
        self.numpy = slave.make_model(parameters)

    def start(self, time, rail):
        self.native.enter(time)
        self.native.set_group("wheel[#].rail_displacement", rail)
        self.native.exit()
        self.numpy.initialise(time, rail)

    def step(self, step_size, rail):
        self.native.set_group("wheel[#].rail_displacement", rail)
        time = self.native.time
        self.native.step(time, step_size)
        self.numpy.step(time, step_size, rail, linear=self.linear)

    def copy_state(self, state):
        self.numpy.state = state
        put_dynamic(self.native, 2 + 2 * (self.wheels + coordinates(self)), state)

    def outputs(self):
        for name in VEHICLE_GROUPS:
            yield name, getattr(self.numpy, name), self.native.group(f"wheel[#].{name}")
        yield from body_outputs(self)


BODY_GROUPS = {
    "bogie_displacement": "bogie[#].displacement",
    "bogie_pitch": "bogie[#].pitch",
    "bogie_acceleration": "bogie[#].acceleration",
    "car_displacement": "car.displacement",
    "car_pitch": "car.pitch",
    "car_acceleration": "car.acceleration",
    "primary_force": "primary[#].force",
    "secondary_force": "secondary[#].force",
}


def body_outputs(pair):
    """Name, numpy's and the native values of the bodies above the wheels."""
    for name, group in BODY_GROUPS.items():
        yield name, np.array(pair.slave.read_model(pair.numpy, name)), pair.native.group(group)


def coordinates(pair):
    """Number of coordinates of a vehicle."""
    return 2 * (pair.wheels + pair.bogies + 1)


def put_dynamic(native, size, state):
    """Set the first of so many dynamic values, which end the block, and the time."""
    block = native.state
    first = len(block) - size
    block[first:] = 0.0
    block[first : first + len(state)] = state
    block[0] = state[1]
    native.state = block
