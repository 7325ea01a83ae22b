"""Why participants are coupled as a whole over a step, and in which order they step."""

import numpy as np
import pytest
from fake_participants import Fake, Linear, static, wire

from orchestrator import Master, MasterSettings, Recorder, System
from orchestrator.block import tear
from orchestrator.exchange import Exchange


def integrators():
    """x' = v and v' = -x as two participants; no output answers to an input without delay."""
    parts = [
        Linear(
            name, inputs=["u"], outputs=["y"], A=[[0]], B=[[gain]], C=[[1]], D=[[0]], x0=[start],
            declares=True,
        )
        for name, gain, start in (("position", 1.0, 1.0), ("velocity", -1.0, 0.0))
    ]  # fmt: skip
    wires = [wire("position.y", "velocity.u"), wire("velocity.y", "position.u")]
    return System(parts, wires)


def swing(algorithm, steps, *, end=10.0, extrapolate=False):
    """Return energy over initial energy and the error of the position at the end."""
    recorder = Recorder(["position.y", "velocity.y"])
    settings = MasterSettings(
        tolerance=None, fixed_step=end / steps, algorithm=algorithm, extrapolate=extrapolate
    )
    Master(integrators(), settings, observers=[recorder]).run(0.0, end)
    position, velocity = recorder["position.y"], recorder["velocity.y"]
    return position[-1] ** 2 + velocity[-1] ** 2, abs(position[-1] - np.cos(end))


def test_a_loop_of_integrators_is_one_block_although_nothing_feeds_through():
    exchange = Exchange(integrators(), indicators=[], observed=[], input_shape="linear")
    (block,) = tear(exchange, everything=False, last=None)
    assert block.unknowns.size == 1


def test_solving_it_together_is_what_gives_it_order_two_and_keeps_its_energy():
    """Straight lines and iteration make it the trapezoidal rule, which keeps x^2 + v^2."""
    errors = []
    for steps in (200, 400):
        energy, error = swing("newton", steps)
        # Residuals up to 1e-7 in each of the steps.
        assert energy == pytest.approx(1.0, abs=steps * 1e-7)
        errors.append(error)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.02)


def test_breaking_it_where_nothing_feeds_through_would_lose_order_and_stability():
    """Values of the last point in its place make it Euler's rule: (1 + h^2)^n times the energy."""
    errors = []
    for steps in (1600, 3200):
        energy, error = swing("jacobi", steps)
        assert energy == pytest.approx((1.0 + (10.0 / steps) ** 2) ** steps, rel=1e-9)
        errors.append(error)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(1.0, abs=0.05)
    # Extrapolation restores the order, not the energy.
    energies = [swing("jacobi", steps, extrapolate=True)[0] for steps in (200, 400)]
    assert min(energies) > 1.0 + 1e-4


def spring_first(*, declares):
    mass = Linear(
        "mass", inputs=["force"], outputs=["x"], A=[[0, 1], [0, 0]], B=[[0], [-1]], C=[[1, 0]],
        D=[[0]], x0=[1, 0], declares=declares,
    )  # fmt: skip
    spring = static("spring", inputs=["x"], outputs=["force"], D=[[100.0]], declares=declares)
    wires = [wire("mass.x", "spring.x"), wire("spring.force", "mass.force")]
    return System([spring, mass], wires)


def force_error(system, *, extrapolate):
    """Return the error of the force, and how far it is from the displacement it belongs to."""
    recorder = Recorder(["mass.x", "spring.force"])
    settings = MasterSettings(
        tolerance=None, fixed_step=0.01, algorithm="gauss_seidel", extrapolate=extrapolate
    )
    Master(system, settings, observers=[recorder]).run(0.0, 1.0)
    force, expected = recorder["spring.force"], 100.0 * np.cos(10.0 * recorder.time)
    return np.abs(force - expected).max(), np.abs(force - 100.0 * recorder["mass.x"]).max()


@pytest.mark.parametrize("extrapolate", [False, True])
def test_what_has_memory_steps_first(extrapolate):
    """The spring answers to what it was told: to the past or a guess of it if it steps first."""
    silent = force_error(spring_first(declares=False), extrapolate=extrapolate)
    declared = force_error(spring_first(declares=True), extrapolate=extrapolate)
    assert declared[1] == 0.0
    assert silent[1] > 0.1
    assert declared[0] < 0.95 * silent[0]


def test_the_fewest_torn_values_count_more_than_memory():
    """The mass without feed-through would step first, but then two values were torn, not one."""
    mass = Linear(
        "mass", inputs=["f1", "f2"], outputs=["x"], A=[[0, 1], [0, 0]], B=[[0, 0], [-1, -1]],
        C=[[1, 0]], D=[[0, 0]], x0=[1, 0], declares=True,
    )  # fmt: skip
    springs = static("springs", inputs=["x"], outputs=["f1", "f2"], D=[[3.0], [4.0]], declares=True)
    wires = [wire(f"springs.{name}", f"mass.{name}") for name in ("f1", "f2")]
    system = System([mass, springs], [*wires, wire("mass.x", "springs.x")])
    exchange = Exchange(system, indicators=[], observed=[], input_shape="linear")
    (block,) = tear(exchange, everything=False, last=None)
    assert block.names == ("mass.x",)


class Contact(Fake):
    """Two springs that cannot pull, pushed to w = (sin t, sin t - 0.5)."""

    inputs, outputs = ("give[1]", "give[2]"), ("force[1]", "force[2]")

    def __init__(self, name, stiffness):
        self.details = {force: {"minimum": 0.0, "nominal": 1.0} for force in self.outputs}
        super().__init__(name)
        self.stiffness = stiffness

    def forces(self, time, give):
        pushed = np.sin(time) - np.array([0.0, 0.5])
        return self.stiffness * np.maximum(pushed - give, 0.0)

    def initial_outputs(self, values):
        return self.forces(self.time, values)

    def advance(self, over):
        return self.forces(over.time + over.step_size, over.end)


@pytest.mark.parametrize("stiffness", [0.3, 0.9, 1.05, 1.5, 4.5])
@pytest.mark.parametrize("coupling", [0.0, 0.25])
def test_bounds_hold_in_steps_at_solutions_on_them(stiffness, coupling):
    """One spring carries all the time, the other one lifts off and touches again."""
    seen = []

    class Support(Linear):
        def set_inputs(self, values):
            seen.append(values.min())
            return super().set_inputs(values)

    support = static(
        "support", inputs=["force[1]", "force[2]"], outputs=["give[1]", "give[2]"],
        D=[[1.0, coupling], [2.0 * coupling, 1.0]], kind=Support,
    )  # fmt: skip
    wires = [wire(f"springs.force[{i}]", f"support.force[{i}]") for i in (1, 2)]
    wires += [wire(f"support.give[{i}]", f"springs.give[{i}]") for i in (1, 2)]
    recorder = Recorder(["springs.force[1]", "springs.force[2]"])
    system = System([support, Contact("springs", stiffness)], wires)
    settings = MasterSettings(tolerance=None, fixed_step=0.05, min_step=1e-3)
    outcome = Master(system, settings, observers=[recorder]).run(0.2, 3.0)
    assert sum(outcome.statistics.rejected.values()) == 0
    assert min(seen) >= 0.0
    first, second = recorder["springs.force[1]"], recorder["springs.force[2]"]
    assert (second == 0.0).any()
    assert (second > 0.01).any()
    # Complementarity: what remains of the law, by the residual tolerance times 1 + gain.
    pushed = np.sin(recorder.time)
    for force, depth in (
        (first, pushed - first - coupling * second),
        (second, pushed - 0.5 - 2.0 * coupling * first - second),
    ):
        assert force == pytest.approx(stiffness * np.maximum(depth, 0.0), abs=1e-6)


def test_two_loops_with_a_chain_between_are_iterated_one_after_another():
    """x = 4 y + 1, y = 1 - x; a chain; u = d - 2 w, w = 1.5 u - 1: gains 4 and 3."""
    parts = [
        static("w", inputs=["u"], outputs=["y"], D=[[1.5]], e=[-1.0]),
        static("chain", inputs=["u"], outputs=["y"], D=[[3.0]], e=[0.5]),
        static("y", inputs=["u"], outputs=["y"], D=[[-1.0]], e=[1.0]),
        static("u", inputs=["w", "d"], outputs=["y"], D=[[-2.0, 1.0]]),
        static("x", inputs=["u"], outputs=["y"], D=[[4.0]], e=[1.0]),
    ]
    wires = [
        wire("x.y", "y.u"), wire("y.y", "x.u"), wire("y.y", "chain.u"), wire("chain.y", "u.d"),
        wire("u.y", "w.u"), wire("w.y", "u.w"),
    ]  # fmt: skip
    system = System(parts, wires)
    exchange = Exchange(system, indicators=[], observed=[], input_shape="linear")
    blocks = tear(exchange, everything=False, last=None)
    assert [block.unknowns.size for block in blocks] == [1, 0, 1]
    recorder = Recorder()
    settings = MasterSettings(tolerance=None, fixed_step=0.5)
    Master(system, settings, observers=[recorder]).run(0.0, 1.0)
    expected = {"x.y": 1.0, "y.y": 0.0, "chain.y": 0.5, "u.y": 0.625, "w.y": -0.0625}
    for name, value in expected.items():
        assert recorder[name] == pytest.approx([value] * 3, abs=1e-6)
