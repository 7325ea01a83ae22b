"""Steps repeated in halves: what they measure, and that they leave no trace."""

import numpy as np
import pytest
from fake_participants import Answering, Linear, Spring, discard, drop, oscillators

from orchestrator import Connection, Master, MasterSettings, Recorder, RollbackError, System


def run(system, end=1.0, events=(), **settings):
    recorder = Recorder()
    outcome = Master(system, MasterSettings(**settings), events=events, observers=[recorder]).run(
        0.0, end
    )
    return outcome, recorder


@pytest.mark.parametrize(
    ("build", "events", "settings"),
    [
        (oscillators, (), {"tolerance": 1e-3, "max_step": 0.1}),
        (drop, ("ball.gap",), {"tolerance": 1e-3, "max_step": 0.02, "min_step": 1e-9}),
        (oscillators, (), {"tolerance": None, "fixed_step": 5e-3, "algorithm": "gauss_seidel"}),
        (oscillators, (), {"tolerance": None, "fixed_step": 5e-3, "algorithm": "jacobi"}),
    ],
)
@pytest.mark.parametrize("every", [1, 7])
def test_an_audited_run_is_the_same_bit_for_bit(build, events, settings, every):
    system = build()
    plain, plain_record = run(build(), events=events, **settings)
    audited, record = run(system, events=events, audit=every, **settings)
    assert plain_record.time.tobytes() == record.time.tobytes()
    assert plain_record.values.tobytes() == record.values.tobytes()
    assert plain.step_log.tobytes() == audited.step_log.tobytes()
    assert plain.audit is None
    assert audited.audit.steps == audited.statistics.accepted // every
    assert audited.audit.failed == 0
    assert [participant.alive for participant in system.participants] == [0, 0]


def test_the_local_error_has_order_three():
    found = [
        run(oscillators(), tolerance=None, fixed_step=size, coupling_tolerance=1e-13, audit=1)[0]
        for size in (4e-3, 2e-3, 1e-3)
    ]
    differences = np.array([outcome.audit.difference for outcome in found])
    assert {outcome.audit.variable for outcome in found} == {"first.velocity"}
    # Velocities are in error by h^3 F'' / 12 times 3/4; the next term is a few percent of it.
    assert np.log2(differences[:-1] / differences[1:]) == pytest.approx([3, 3], abs=0.05)


def test_the_measured_error_is_the_known_one():
    # y' = u with u = y^2 rising from 1 on a straight line: one trapezoidal step against two. With
    # y = 1 + h + h^2 + ..., the rule is off by h^3 u'' / 12, u'' = 6 y^4, and 3/4 of it is seen.
    size = 1e-3
    integrator = Linear(
        "integrator", inputs=["u"], outputs=["y"], A=[[0]], B=[[1]], C=[[1]], D=[[0]], x0=[1]
    )
    square = Spring("square", lambda y: y * y)
    wires = [
        Connection(source="integrator.y", target="square.displacement"),
        Connection(source="square.force", target="integrator.u"),
    ]
    outcome, _ = run(
        System([integrator, square], wires),
        end=size,
        tolerance=None,
        fixed_step=size,
        coupling_tolerance=1e-14,
        audit=1,
    )
    assert outcome.audit.variable == "square.force"
    # The force is twice as sensitive as y where y is 1; the next term is of the order of h.
    assert outcome.audit.difference == pytest.approx(2 * 0.75 * size**3 / 2, rel=0.02)


def test_an_honest_nominal_value_is_left_alone_and_a_lying_one_is_caught():
    settings = {"tolerance": 1e-3, "max_step": 0.2, "initial_step": 1e-3, "end": 2.0}
    honest, _ = run(oscillators(), audit=3, **settings)
    assert honest.warnings == ()
    assert 0.0 < honest.audit.optimism < 0.3
    lying, _ = run(oscillators(nominal=1e6), audit=3, **settings)
    assert lying.audit.optimism > 10.0
    *_, warning = lying.warnings  # after those about values too small for their nominal values
    assert "The audit measured" in warning
    assert f"in {lying.audit.variable} between" in warning


def test_halves_without_a_result_are_counted_and_harmless():
    def script(_time, step_size):
        return discard() if step_size < 0.06 else None

    source = Linear(
        "source",
        inputs=[],
        outputs=["y"],
        A=[[0]],
        B=np.zeros((1, 0)),
        C=[[1]],
        D=np.zeros((1, 0)),
        x0=[1],
    )
    system = System(
        [source, Answering("answering", script)],
        [Connection(source="source.y", target="answering.u")],
    )
    outcome, recorder = run(
        system, tolerance=None, fixed_step=0.1, algorithm="jacobi", audit=2, check_rollback=False
    )
    assert (outcome.audit.steps, outcome.audit.failed) == (5, 5)
    assert recorder["answering.y"][-1] == pytest.approx(1.0, abs=1e-14)


def test_participants_that_cannot_go_back_are_refused():
    system = oscillators()
    system.participants[1].can_save_state = False
    settings = {"tolerance": None, "fixed_step": 1e-2, "algorithm": "jacobi"}
    with pytest.raises(RollbackError, match=r"second cannot save its state.*leave .* audit out"):
        run(system, audit=1, **settings)
