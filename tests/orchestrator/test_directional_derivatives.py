"""Directional derivatives as a first guess of a loop's Jacobian, true and false ones."""

import numpy as np
import pytest
from fake_participants import Linear, discard, oscillators, static, wire

from orchestrator import (
    FmuParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    Status,
    StatusKind,
    System,
)
from orchestrator import Linear as Conversion
from orchestrator.block import tear
from orchestrator.exchange import Exchange

scales = np.array([1e5, 1e-3])


class Pushed(Linear):
    """A participant without memory whose offset is pushed along a sine."""

    def advance(self, over):
        return super().advance(over) + np.sin(over.time + over.step_size) * self.push

    def initial_outputs(self, values):
        return super().initial_outputs(values) + np.sin(self.time) * self.push


push = scales * [1.0, -0.5]


def loop(strength, *, derivatives=None, kind=Pushed):
    """Three participants; what goes round is multiplied by a matrix that is not symmetric.

    The scales of the two values are eight decades apart, and the last connection converts.
    """
    random = np.random.default_rng(11)
    gains = [random.normal(size=(2, 2)) for _ in range(3)]
    gains[0] = gains[0] + [[0.0, 3.0], [0.0, 0.0]]
    radius = np.abs(np.linalg.eigvals(gains[2] @ gains[1] @ gains[0])).max()
    gains = [np.diag(scales) @ gain @ np.diag(1.0 / scales) for gain in gains]
    gains[2] *= strength / radius
    details = {f"y{i}": {"nominal": scale} for i, scale in enumerate(scales)}
    participants, wires = [], []
    for n in range(3):
        own = gains[n] @ np.diag([0.5, 1.0]) if n == 0 else gains[n]
        part = static(
            f"p{n}", inputs=["u0", "u1"], outputs=["y0", "y1"], D=own, details=details,
            derivatives=derivatives, kind=kind,
        )  # fmt: skip
        part.push = push if n == 0 else np.zeros(2)
        participants.append(part)
        conversion = Conversion(factor=2.0) if n == 2 else None
        wires += [
            wire(f"p{n}.y0", f"p{(n + 1) % 3}.u0", conversion),
            wire(f"p{n}.y1", f"p{(n + 1) % 3}.u1"),
        ]
    return System(participants, wires), gains


def run(system, **options):
    recorder = Recorder(["p0.y0", "p0.y1"])
    settings = MasterSettings(**{"tolerance": None, "fixed_step": 0.1, **options})
    outcome = Master(system, settings, observers=[recorder]).run(0.0, 1.0)
    return outcome, recorder


def error(recorder, gains):
    """Largest deviation from the closed form over the nominal values."""
    through = gains[0] @ gains[2] @ gains[1]
    exact = np.outer(np.linalg.solve(np.eye(2) - through, push), np.sin(recorder.time))
    return max(np.abs(recorder[f"p0.y{i}"] - exact[i]).max() / scales[i] for i in range(2))


ladder = [0.3, 0.9, 1.05, 1.5, 4.5]


@pytest.mark.parametrize("strength", ladder)
def test_the_first_step_needs_no_finite_differences(strength):
    iterations = []
    for derivatives in (np.copy, None):
        system, gains = loop(strength, derivatives=derivatives)
        outcome, recorder = run(system)
        # Residual 1e-7; what is left of it is multiplied by the inverse of 1 - gain.
        assert error(recorder, gains) < 1e-5
        iterations.append(outcome.statistics.iterations)
        steps = outcome.statistics.accepted
    # The residual and one exact correction, in every step.
    assert iterations[0] == 2 * steps
    assert iterations[1] >= iterations[0] + 2


def noisy(gains):
    return gains * np.array([[1.1, 0.8], [0.9, 1.2]])


lies = {
    "transposed": np.transpose,
    "zero": np.zeros_like,
    "wrong sign": np.negative,
    "not a number": lambda gains: np.full_like(gains, np.nan),
    "infinite": lambda gains: np.full_like(gains, np.inf),
    "too large": lambda gains: 1e12 * gains,
    "inaccurate": noisy,
    "discarded": lambda _: Status(StatusKind.DISCARD, "fmi2GetDirectionalDerivative"),
    "failing": lambda _: Status(StatusKind.ERROR, "fmi2GetDirectionalDerivative"),
}


@pytest.mark.parametrize("strength", [0.3, 1.05, 4.5])
@pytest.mark.parametrize("lie", lies.values(), ids=lies.keys())
def test_wrong_derivatives_change_no_answer(lie, strength):
    without = run(loop(strength)[0])[0].statistics
    system, gains = loop(strength, derivatives=lie)
    outcome, recorder = run(system)
    assert error(recorder, gains) < 1e-5
    assert outcome.statistics.accepted == without.accepted
    assert outcome.statistics.rejected == without.rejected
    # The correction that was tried; differences and all else are as without derivatives.
    assert outcome.statistics.iterations <= without.iterations + 1


@pytest.mark.parametrize("lie", [lies["too large"], np.negative], ids=["too large", "wrong sign"])
def test_a_step_refused_because_of_wrong_derivatives_is_no_rejection(lie):
    class Narrow(Pushed):
        def advance(self, over):
            far = np.abs(over.end / scales).max() > 20.0
            return discard() if far else super().advance(over)

    system, gains = loop(0.9, derivatives=lie, kind=Narrow)
    outcome, recorder = run(system)
    assert sum(outcome.statistics.rejected.values()) == 0
    assert error(recorder, gains) < 1e-5


def test_a_death_on_the_way_to_the_derivatives_ends_the_run():
    system, _ = loop(0.9, derivatives=lambda _: Status(StatusKind.FATAL, "the call ended fatally"))
    with pytest.raises(ParticipantError, match="ended fatally"):
        run(system)


def lay_out(system, step_size):
    exchange = Exchange(system, indicators=[], observed=[], input_shape="linear")
    for stage in exchange.stages:
        stage.participant.instantiate()
        stage.participant.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
        stage.read_outputs()
        stage.participant.exit_initialisation()
        stage.save()
    (block,) = tear(exchange, everything=False, last=None)
    assert block.step(np.zeros(block.unknowns.size), 0.0, step_size) is None
    return exchange, block


def differenced(block, step_size):
    """The interface Jacobian of G(z) - z, scaled, by differences of a linear map."""
    columns = []
    for increment in np.diag(block.nominal):
        assert block.step(increment, 0.0, step_size) is None
        there = block.computed()
        assert block.step(np.zeros(len(increment)), 0.0, step_size) is None
        columns.append((there - block.computed()) / block.nominal)
    return np.array(columns).T - np.eye(len(columns))


def test_the_chain_rule_gives_the_interface_jacobian():
    system, _ = loop(1.5, derivatives=np.copy)
    _, block = lay_out(system, 0.1)
    jacobian = differenced(block, 0.1)
    assert np.abs(jacobian - jacobian.T).max() > 0.1
    # Sums of sines that vanish at the start of the step leave rounding only.
    assert np.linalg.inv(block.guess()) == pytest.approx(jacobian, abs=1e-9)


@pytest.mark.parametrize("step_size", [1e-2, 1e-3])
def test_what_derivatives_leave_out_over_a_step_vanishes_with_it(step_size):
    """The force on a mass comes back through its velocity, by damping times h/2."""
    system = oscillators(kc=0.0, dc=1.0)
    for participant in system.participants:
        participant.derivatives, participant.provides_directional_derivatives = np.copy, True
    _, block = lay_out(system, step_size)
    left_out = np.linalg.inv(block.guess()) - differenced(block, step_size)
    assert np.abs(left_out).max() == pytest.approx(0.5 * step_size, rel=2e-2)


def test_without_derivatives_there_is_no_guess():
    assert lay_out(loop(0.9)[0], 0.1)[1].guess is None
    system, _ = loop(0.9, derivatives=np.copy)
    system.participants[1].provides_directional_derivatives = False
    assert lay_out(system, 0.1)[1].guess is None
    # One that passes nothing on at once needs no derivatives.
    system.participants[1].dependencies = {"y0": frozenset(), "y1": frozenset()}
    assert np.linalg.inv(lay_out(system, 0.1)[1].guess()) == pytest.approx(-np.eye(2))


def test_runs_with_derivatives_repeat_themselves_bit_for_bit():
    histories = [run(loop(1.5, derivatives=noisy)[0], min_step=1e-3)[1].values for _ in range(2)]
    assert histories[0].tobytes() == histories[1].tobytes()


@pytest.mark.parametrize("fmi_version", [2, 3])
@pytest.mark.parametrize("gain", [0.3, 4.5])
def test_the_derivatives_of_an_fmu_spare_the_differences(compiled_fmu, fmi_version, gain):
    """y = gain u, u = 1 - y, at the start and in every step."""
    values = []
    for derivatives in (np.copy, None):
        fmu = FmuParticipant(
            compiled_fmu("gain", fmi_version), name="fmu", start_values={"gain": gain}
        )
        rest = static(
            "rest", inputs=["u"], outputs=["y"], D=[[-1.0]], e=[1.0], derivatives=derivatives,
            kind=Stepping,
        )  # fmt: skip
        system = System([fmu, rest], [wire("fmu.y", "rest.u"), wire("rest.y", "fmu.u")])
        recorder = Recorder(["fmu.y"])
        settings = MasterSettings(tolerance=None, fixed_step=0.5)
        outcome = Master(system, settings, observers=[recorder]).run(0.0, 0.5)
        assert recorder["fmu.y"][0] == pytest.approx(gain / (1.0 + gain), abs=1e-9)
        assert recorder["fmu.y"][-1] == pytest.approx(2.0 * gain / (1.0 + gain), abs=1e-6)
        values.append(outcome.statistics.iterations)
    # The residual and one correction; one more for the difference.
    assert values == [2, 3]


class Stepping(Linear):
    """One more after the first step."""

    def advance(self, over):
        return super().advance(over) + 1.0
