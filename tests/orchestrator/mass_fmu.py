"""A small FMU with many faults on demand, built with pythonfmu."""

from pythonfmu.builder import FmuBuilder

slave = '''
import ctypes
import os
import pickle
import time as time_module

from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real, String
from pythonfmu.enums import Fmi2Status


class State(dict):
    """A saved state; the class counts how many of them live."""

    alive = 0

    def __init__(self, values):
        super().__init__(values)
        State.alive += 1

    def __del__(self):
        State.alive -= 1


class {name}(Fmi2Slave):
    """A mass, exact for forces on straight lines; `trouble` makes it misbehave."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.force, self.last_force = 0.0, 0.0
        self.x, self.v, self.steps, self.moving = 1.0, 0.0, 0, False
        self.mass, self.trouble, self.label, self.linear_inputs = 1.0, 0, "", False
        fixed = {{"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}}
        counted = {{"causality": Fmi2Causality.output, "variability": Fmi2Variability.discrete}}
        self.register_variable(Real("force", causality=Fmi2Causality.input))
        self.register_variable(Real("x", causality=Fmi2Causality.output))
        self.register_variable(Integer("steps", **counted))
        self.register_variable(Real("v", causality=Fmi2Causality.output))
        self.register_variable(Boolean("moving", **counted))
        self.register_variable(Real("mass", **fixed))
        self.register_variable(Integer("trouble", **fixed))
        self.register_variable(String("label", **fixed))
        self.register_variable(Boolean("linear_inputs", **fixed))

    def exit_initialization_mode(self):
        self.last_force = self.force
        if self.trouble == 3:
            raise ValueError("no initial state, 100 % sure")

    def do_step(self, time, step):
        if self.trouble == 1 and step > 0.015:
            self.log(f"a step of {{step:.3f}} s is too long", Fmi2Status.warning)
            return False
        if self.trouble == 11 and not 4.9 < self.force < 5.1:
            self.log(f"a force of {{self.force}} N is far from 5 N", Fmi2Status.warning)
            return False
        if self.trouble == 2 and time > 0.5:
            raise ValueError("broken axle")
        if self.trouble in {{5, 6, 7, 8, 9}} and time > 0.5 and self.fuse():
            self.misbehave()
        start = (self.last_force if self.linear_inputs else self.force) / self.mass
        end = self.force / self.mass
        self.x += step * self.v + step**2 * (2.0 * start + end) / 6.0
        self.v += step * (start + end) / 2.0
        self.last_force, self.steps, self.moving = self.force, self.steps + 1, True
        return True

    def fuse(self):
        """With a label: whether the file of that name was not there, which is now."""
        if not self.label:
            return True
        if os.path.exists(self.label):
            return False
        open(self.label, "w").close()
        return True

    def misbehave(self):
        if self.trouble == 5:
            os.abort()
        if self.trouble == 6:
            ctypes.string_at(0)
        if self.trouble == 7:
            os._exit(7)
        if self.trouble == 8:
            time_module.sleep(3600.0)
        self.x = float("nan")

    def _get_fmu_state(self):
        if self.trouble == 10:
            self.hoard = getattr(self, "hoard", []) + [bytearray(10000)]
        kept = ("x", "v", "force", "last_force", "steps", "moving")
        return State((name, getattr(self, name)) for name in kept)

    def _set_fmu_state(self, state):
        for name, value in state.items():
            if not (self.trouble == 4 and name == "v"):
                setattr(self, name, value)

    @staticmethod
    def _fmu_state_to_bytes(state):
        return pickle.dumps(dict(state))

    @staticmethod
    def _fmu_state_from_bytes(data):
        return State(pickle.loads(data))
'''


def build(folder, name, **options):
    source = folder / f"{name.lower()}_slave.py"
    source.write_text(slave.format(name=name))
    options = {"canGetAndSetFMUstate": True, "canSerializeFMUstate": True, **options}
    return FmuBuilder.build_FMU(source, dest=folder, needsExecutionTool=False, **options)
