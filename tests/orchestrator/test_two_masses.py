"""Two masses coupled in a force/displacement split, against the closed form."""

import numpy as np
import pytest
from fake_participants import oscillators, oscillators_exact

from orchestrator import Master, MasterSettings, Recorder

soft = {"kc": 10.0, "dc": 0.5}
end = 2.0


def end_error(system, settings, exact):
    recorder = Recorder(["first.displacement"])
    Master(system, settings, observers=[recorder]).run(0.0, end)
    return abs(recorder["first.displacement"][-1] - exact[0])


@pytest.mark.parametrize(
    ("algorithm", "extrapolate", "order", "slack"),
    [
        ("newton", True, 2, 0.01),
        ("gauss_seidel", True, 2, 0.02),
        ("jacobi", True, 2, 0.02),
        ("gauss_seidel", False, 1, 0.01),
        ("jacobi", False, 1, 0.05),
    ],
)
def test_observed_order(algorithm, extrapolate, order, slack):
    exact = oscillators_exact(end, **soft)
    errors = [
        end_error(
            oscillators(**soft),
            MasterSettings(
                tolerance=None,
                fixed_step=end / steps,
                algorithm=algorithm,
                extrapolate=extrapolate,
            ),
            exact,
        )
        for steps in (200, 400, 800)
    ]
    observed = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # At these steps the next term of the error changes the order by a few hundredths at most.
    assert observed == pytest.approx([order, order], abs=slack)


def test_stiff_coupling_meets_the_reference_value():
    # Issue value: x1(2) = 0.44247647 for m 1, k 10, coupling stiffness 100 and damping 1.
    exact = oscillators_exact(end)
    assert exact[0] == pytest.approx(0.44247647, abs=5e-9)
    settings = MasterSettings(tolerance=1e-5, max_step=0.1, initial_step=1e-4)
    # The end error stays below the tolerance of a single step, since the errors alternate.
    assert end_error(oscillators(), settings, exact) < 1e-6


def test_error_shrinks_in_proportion_to_the_tolerance():
    exact = oscillators_exact(end)
    errors = [
        end_error(
            oscillators(),
            MasterSettings(tolerance=tolerance, max_step=0.1, initial_step=1e-4),
            exact,
        )
        for tolerance in (1e-2, 1e-3, 1e-4)
    ]
    assert np.array(errors[:-1]) / np.array(errors[1:]) == pytest.approx([10, 10], rel=0.4)


def test_steps_come_from_a_geometric_grid():
    settings = MasterSettings(tolerance=1e-3, max_step=0.1, initial_step=1e-4)
    log = Master(oscillators(), settings).run(0.0, end).step_log
    # The two last steps share what is left; all others are the largest step over 2^(n/4).
    steps = np.unique(log["step_size"][:-2])
    exponents = 4.0 * np.log2(0.1 / steps)
    assert exponents == pytest.approx(np.round(exponents), abs=1e-9)
    assert steps.size > 3


def test_repeated_runs_agree_bit_for_bit():
    settings = MasterSettings(tolerance=1e-3, max_step=0.1, initial_step=1e-4)
    master_recorders = []
    for check in (True, False):
        recorder = Recorder()
        chosen = MasterSettings(
            tolerance=settings.tolerance, max_step=0.1, initial_step=1e-4, check_rollback=check
        )
        Master(oscillators(), chosen, observers=[recorder]).run(0.0, end)
        master_recorders.append(recorder)
    first, second = master_recorders
    assert first.time.tobytes() == second.time.tobytes()
    assert first.values.tobytes() == second.values.tobytes()
