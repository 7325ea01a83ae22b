"""In-process participants with exact, closed-form steps."""

from copy import deepcopy
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from orchestrator import OK, Connection, Status, StatusKind, System, Variable


class Over(NamedTuple):
    """A step and the values of all inputs at its start and at its end."""

    time: float
    step_size: float
    start: np.ndarray
    end: np.ndarray


class Fake:
    """A participant whose model is the method `advance` and whose state is `self.state`.

    `advance` gets an `Over` and returns the outputs. Inputs run on straight lines when asked for,
    else they are held at their end value.
    """

    can_serialise_state = False
    can_vary_step = True
    provides_directional_derivatives = False
    inputs = ()
    outputs = ()
    details = MappingProxyType({})

    def __init__(self, name, *, can_save_state=True):
        self.name = name
        self.can_save_state = can_save_state
        self.messages = []
        self.input_shape = "held"
        self.variables = {}
        for causality, names in (("input", self.inputs), ("output", self.outputs)):
            for variable in names:
                details = self.details.get(variable, {})
                self.variables[variable] = Variable(name=variable, causality=causality, **details)
        self.dependencies = dict.fromkeys(self.outputs)
        self.calls = []
        self.alive = 0
        self.state = None

    @property
    def initial_dependencies(self):
        return self.dependencies

    def bind(self, *, inputs, outputs, observed, input_shape):
        self.input_shape = input_shape
        self._into = [self.inputs.index(name) for name in inputs]
        self._from = [self.outputs.index(name) for name in outputs]
        self._watched = list(observed)

    def instantiate(self):
        self.values = np.zeros(len(self.inputs))
        self.held = np.zeros(len(self.inputs))
        self.result = np.zeros(len(self.outputs))
        self.state = self.initial_state()
        self.calls.append("instantiate")

    def initial_state(self):
        return None

    def enter_initialisation(self, **experiment):
        self.time = experiment["start_time"]
        self.initialising = True
        self.calls.append("enter")

    def exit_initialisation(self):
        self.initialising = False
        self.held = self.values.copy()
        self.calls.append("exit")

    def set_inputs(self, values):
        self.values[self._into] = values
        return OK

    def get_outputs(self, out):
        if self.initialising:
            self.result[:] = self.initial_outputs(self.values)
        out[:] = self.result[self._from]
        return OK

    def get_observed(self, out):
        for place, name in enumerate(self._watched):
            if name in self.outputs:
                out[place] = self.result[self.outputs.index(name)]
            else:
                out[place] = self.values[self.inputs.index(name)]
        return OK

    def step(self, time, step_size):
        start = self.held if self.input_shape == "linear" else self.values
        answer = self.advance(Over(time, step_size, start, self.values))
        if isinstance(answer, Status):
            return answer
        self.result[:] = answer
        self.held = self.values.copy()
        self.time = time + step_size
        return OK

    def directional_derivatives(self, out):
        raise NotImplementedError

    def save(self):
        self.alive += 1
        return deepcopy((self.state, self.held, self.values, self.result, self.time))

    def restore(self, state):
        self.state, self.held, self.values, self.result, self.time = deepcopy(state)

    def release(self, state):
        assert state is not None
        self.alive -= 1

    def serialise(self, state):
        raise NotImplementedError

    def deserialise(self, data):
        raise NotImplementedError

    def terminate(self):
        self.calls.append("terminate")

    def free(self):
        self.calls.append("free")


class Linear(Fake):
    """x' = A x + B u + c, y = C x + D u + e, exact for inputs on straight lines.

    With `declares` it says what D says; with `derivatives` it gives what that makes of D.
    """

    def __init__(
        self,
        name,
        *,
        inputs,
        outputs,
        A,
        B,
        C,
        D,
        x0,
        c=None,
        e=None,
        declares=False,
        derivatives=None,
        **options,
    ):
        self.inputs, self.outputs = tuple(inputs), tuple(outputs)
        self.details = options.pop("details", {})
        super().__init__(name, **options)
        self.derivatives = derivatives
        self.provides_directional_derivatives = derivatives is not None
        if declares:
            self.dependencies = {
                output: frozenset(name for name, gain in zip(inputs, row, strict=True) if gain)
                for output, row in zip(outputs, np.array(D).tolist(), strict=True)
            }
        self.A, self.B, self.C, self.D = (np.array(m, dtype=float) for m in (A, B, C, D))
        self.c = np.zeros(len(self.A)) if c is None else np.array(c, dtype=float)
        self.e = np.zeros(len(self.C)) if e is None else np.array(e, dtype=float)
        self.x0 = np.array(x0, dtype=float)
        self.operators = {}

    def initial_state(self):
        return self.x0.copy()

    def initial_outputs(self, values):
        return self.C @ self.state + self.D @ values + self.e

    def directional_derivatives(self, out):
        answer = self.derivatives(self.D)
        if isinstance(answer, Status):
            return answer
        out[:] = answer[np.ix_(self._from, self._into)]
        return OK

    def advance(self, over):
        step_size = over.step_size
        if step_size not in self.operators:
            n, m = self.B.shape
            big = np.zeros((n + 2 * m + 1, n + 2 * m + 1))
            big[:n, :n], big[:n, n : n + m], big[:n, -1] = self.A, self.B, self.c
            big[n : n + m, n + m : n + 2 * m] = np.eye(m) / step_size
            self.operators[step_size] = expm(big * step_size)[:n]
        everything = np.concatenate([self.state, over.start, over.end - over.start, [1.0]])
        self.state = self.operators[step_size] @ everything
        return self.C @ self.state + self.D @ over.end + self.e


def static(name, *, inputs, outputs, D, e=None, kind=Linear, **options):
    """y = D u + e, without memory."""
    return kind(
        name,
        inputs=inputs,
        outputs=outputs,
        A=np.zeros((0, 0)),
        B=np.zeros((0, len(inputs))),
        C=np.zeros((len(outputs), 0)),
        D=D,
        e=e,
        x0=[],
        **options,
    )


def wire(source, target, conversion=None):
    return Connection(source=source, target=target, conversion=conversion)


class Spring(Fake):
    """A force without memory: force = law(displacement)."""

    inputs = ("displacement",)
    outputs = ("force",)

    def __init__(self, name, law, *, details=None, **options):
        self.details = details or {}
        self.law = law
        super().__init__(name, **options)

    def initial_outputs(self, values):
        return [self.law(values[0])]

    def advance(self, over):
        return [self.law(over.end[0])]


class Answering(Fake):
    """Integrates its input, but answers as `script(time, step_size)` says when that is not None."""

    inputs = ("u",)
    outputs = ("y",)

    def __init__(self, name, script, **options):
        super().__init__(name, **options)
        self.script = script

    def initial_state(self):
        return 0.0

    def initial_outputs(self, _values):
        return [self.state]

    def advance(self, over):
        answer = self.script(over.time, over.step_size)
        if isinstance(answer, Status | float):
            return answer if isinstance(answer, Status) else [answer]
        self.state += 0.5 * over.step_size * (over.start[0] + over.end[0])
        return [self.state]


def discard(until=None):
    return Status(StatusKind.DISCARD, "the step ended with fmi2Discard", until)


def oscillators(kc=100.0, dc=1.0, k=10.0, m=1.0, x1=1.0, nominal=1.0):
    """Two masses on springs, coupled by a spring and damper that belongs to the second one."""
    details = {"displacement": {"nominal": nominal}, "velocity": {"nominal": nominal}}
    first = Linear(
        "first",
        inputs=["force"],
        outputs=["displacement", "velocity"],
        A=[[0, 1], [-k / m, 0]],
        B=[[0], [-1 / m]],
        C=np.eye(2),
        D=np.zeros((2, 1)),
        x0=[x1, 0],
        details=details,
    )
    second = Linear(
        "second",
        inputs=["displacement", "velocity"],
        outputs=["force", "own_displacement"],
        A=[[0, 1], [-(k + kc) / m, -dc / m]],
        B=[[0, 0], [kc / m, dc / m]],
        C=[[-kc, -dc], [1, 0]],
        D=[[kc, dc], [0, 0]],
        x0=[0, 0],
        details={"force": {"nominal": 100.0 * nominal}},
    )
    wires = [
        Connection(source="first.displacement", target="second.displacement"),
        Connection(source="first.velocity", target="second.velocity"),
        Connection(source="second.force", target="first.force"),
    ]
    return System([first, second], wires)


def oscillators_exact(t, kc=100.0, dc=1.0, k=10.0, m=1.0, x1=1.0):
    """x1, x2, v1, v2 of the two masses at time t."""
    stiffness = np.array([[k + kc, -kc], [-kc, k + kc]]) / m
    damping = np.array([[dc, -dc], [-dc, dc]]) / m
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness, -damping]])
    return expm(A * t) @ np.array([x1, 0, 0, 0])


class Contact(Spring):
    """A spring that is told the velocity too and does not use it: a contact without damping."""

    inputs = ("displacement", "velocity")


def drop(
    mass=1.0,
    stiffness=1e4,
    gravity=10.0,
    height=0.1,
    power=1.0,
    displacement_nominal=0.1,
    exchanges_velocity=False,
):
    """A mass that falls on a spring that cannot pull: x downwards, contact for x > 0."""
    ball = Linear(
        "ball",
        inputs=["force"],
        outputs=["displacement", "velocity", "gap"],
        A=[[0, 1], [0, 0]],
        B=[[0], [-1 / mass]],
        C=[[1, 0], [0, 1], [-1, 0]],
        D=np.zeros((3, 1)),
        c=[0, gravity],
        x0=[-height, 0],
        details={"displacement": {"nominal": displacement_nominal}, "velocity": {"nominal": 1.4}},
    )
    spring = (Contact if exchanges_velocity else Spring)(
        "spring",
        lambda x: stiffness * max(x, 0.0) ** power,
        details={"force": {"nominal": 1e2, "minimum": 0.0}},
    )
    wires = [
        Connection(source="ball.displacement", target="spring.displacement"),
        Connection(source="spring.force", target="ball.force"),
    ]
    if exchanges_velocity:
        wires.append(Connection(source="ball.velocity", target="spring.velocity"))
    return System([ball, spring], wires)
