"""FMUs of masses, springs and memoryless relations, built with pythonfmu.

Each is exact for inputs that are held or run on straight lines, so that every error of a run is the
master's.
"""

from pythonfmu.builder import FmuBuilder

head = '''
from math import sin

from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Real
from scipy.linalg import expm

# pythonfmu 0.7 gives back a reference to this namespace that it never took (its issue 228).
globals().setdefault("namespaces", []).append(globals())


class Scaled(Real):
    """A Real with a nominal value."""

    def __init__(self, name, nominal, **kwargs):
        super().__init__(name, **kwargs)
        self.nominal = nominal

    def to_xml(self):
        element = super().to_xml()
        element.find("Real").set("nominal", repr(self.nominal))
        return element


class State(dict):
    """A saved state; the class counts how many of them live, and lived at most."""

    alive = most = 0

    def __init__(self, values):
        super().__init__(values)
        State.alive += 1
        State.most = max(State.most, State.alive)

    def __del__(self):
        State.alive -= 1


class Base(Fmi2Slave):
    """Variables by nominal value, and the complete state as a dictionary."""

    inputs, outputs, parameters, kept = {}, {}, (), ()

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.linear_inputs = False
        for name in (*self.inputs, *self.parameters):
            setattr(self, name, 0.0)
        for name, nominal in self.inputs.items():
            self.register_variable(Scaled(name, nominal, causality=Fmi2Causality.input))
        for name, nominal in self.outputs.items():
            self.register_variable(Scaled(name, nominal, causality=Fmi2Causality.output))
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        for name in self.parameters:
            self.register_variable(Real(name, **fixed))
        self.register_variable(Boolean("linear_inputs", **fixed))

    def _get_fmu_state(self):
        return State((name, getattr(self, name)) for name in (*self.inputs, *self.kept))

    def _set_fmu_state(self, state):
        for name, value in state.items():
            setattr(self, name, value)

'''

mass = '''
class ConformanceMass(Base):
    """m x'' = -k x + F + K (xo - x) + D (vo - v), where the other mass is at xo."""

    inputs = {"force": 100.0, "other_displacement": 1.0, "other_velocity": 10.0}
    outputs = {"displacement": 1.0, "velocity": 10.0, "coupling_force": 100.0}
    parameters = ("mass", "stiffness", "coupling_stiffness", "coupling_damping", "start")
    kept = ("displacement", "velocity", "drive")

    def __init__(self, **kwargs):
        self.displacement = self.velocity = self.drive = 0.0
        super().__init__(**kwargs)
        self.mass = 1.0
        self.operators = {}

    @property
    def coupling_force(self):
        """On the other mass."""
        return self.coupling_stiffness * (self.displacement - self.other_displacement) + (
            self.coupling_damping * (self.velocity - self.other_velocity)
        )

    def driven(self):
        return (
            self.force
            + self.coupling_stiffness * self.other_displacement
            + self.coupling_damping * self.other_velocity
        ) / self.mass

    def enter_initialization_mode(self):
        self.displacement = self.start

    def exit_initialization_mode(self):
        self.drive = self.driven()

    def operator(self, step):
        if step not in self.operators:
            a = -(self.stiffness + self.coupling_stiffness) / self.mass
            b = -self.coupling_damping / self.mass
            change = [[0, 1, 0, 0], [a, b, 1, 0], [0, 0, 0, 1 / step], [0, 0, 0, 0]]
            over = [[step * value for value in row] for row in change]
            self.operators[step] = expm(over)[:2].tolist()
        return self.operators[step]

    def do_step(self, time, step):
        end = self.driven()
        begin = self.drive if self.linear_inputs else end
        values = (self.displacement, self.velocity, begin, end - begin)
        self.displacement, self.velocity = (
            sum(factor * value for factor, value in zip(row, values, strict=True))
            for row in self.operator(step)
        )
        self.drive = end
        return True
'''

spring = '''
class ConformanceSpring(Base):
    """force = K (xo - x) + D (vo - v): what it does to the first mass."""

    inputs = {
        "displacement": 1.0,
        "velocity": 10.0,
        "other_displacement": 1.0,
        "other_velocity": 10.0,
    }
    outputs = {"force": 100.0}
    parameters = ("stiffness", "damping")

    @property
    def force(self):
        return self.stiffness * (self.other_displacement - self.displacement) + (
            self.damping * (self.other_velocity - self.velocity)
        )

    def do_step(self, time, step):
        return True
'''

relation = '''
class ConformanceRelation(Base):
    """y = factor u + amplitude sin(t), without memory."""

    inputs = {"u": 1.0}
    outputs = {"y": 1.0}
    parameters = ("factor", "amplitude")
    kept = ("time",)

    def __init__(self, **kwargs):
        self.time = 0.0
        super().__init__(**kwargs)

    def setup_experiment(self, start_time, stop_time, tolerance):
        self.time = start_time

    @property
    def y(self):
        return self.factor * self.u + self.amplitude * sin(self.time)

    def do_step(self, time, step):
        self.time = time + step
        return True
'''

models = {"mass": mass, "spring": spring, "relation": relation}


def build(folder):
    """Build all of them as mass.fmu, spring.fmu and relation.fmu."""
    for name, model in models.items():
        source = folder / f"conformance_{name}.py"
        source.write_text(head + model)
        built = FmuBuilder.build_FMU(
            source,
            dest=folder,
            needsExecutionTool=False,
            canGetAndSetFMUstate=True,
            canSerializeFMUstate=True,
        )
        built.rename(folder / f"{name}.fmu")
