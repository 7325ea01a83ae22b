"""Two coupled masses in three splits, as FMUs, against the closed form."""

import numpy as np
import pytest
from scipy.linalg import expm

from tests.conformance.systems import oscillator, splits

end, kc, dc = 2.0, 100.0, 1.0


def closed_form(times):
    """Displacements of two masses of 1 kg on springs of 10 N/m, the first from 1 m, at rest."""
    change = np.array(
        [
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [-10.0 - kc, kc, -dc, dc],
            [kc, -10.0 - kc, dc, -dc],
        ]
    )
    # All at once is slow: from one of the equal steps to the next instead.
    over = expm(change * (times[1] - times[0]))
    states = [np.array([1.0, 0.0, 0.0, 0.0])]
    for _ in times[1:]:
        states.append(over @ states[-1])
    return np.array(states)[:, :2]


def error(result):
    """Root mean square over all times and both masses: no zero crossing spoils its order."""
    found = np.stack([result[f"{name}.displacement"] for name in ("first", "second")], axis=1)
    return np.sqrt(np.mean((found - closed_form(result["time"].to_numpy())) ** 2))


cases = {
    # Straight lines between the right values: the next term is two orders smaller.
    "newton": ("newton", True, (200, 400, 800), 2, 0.02),
    # Delayed values bring a damping of their own, and its next term is one order smaller only.
    "extrapolated gauss_seidel": ("gauss_seidel", True, (1600, 3200), 2, 0.05),
    "extrapolated jacobi": ("jacobi", True, (1600, 3200), 2, 0.05),
    "held gauss_seidel": ("gauss_seidel", False, (2000, 4000), 1, 0.08),
    "held jacobi": ("jacobi", False, (2000, 4000), 1, 0.08),
}


@pytest.mark.parametrize(
    ("case", "split"),
    [
        pytest.param(case, split, marks=[] if quick else pytest.mark.slow)
        for case in cases
        for split in splits
        for quick in [case == "newton" or split == "force/displacement"]
    ],
)
def test_observed_order(run, case, split):
    algorithm, extrapolate, counts, order, slack = cases[case]
    text = oscillator(split, algorithm=algorithm, extrapolate=extrapolate)
    errors = [error(run(text, step=end / steps)) for steps in counts]
    observed = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert observed == pytest.approx(np.full(observed.shape, float(order)), abs=slack)


@pytest.mark.parametrize(("split", "unknowns"), list(zip(splits, (1, 2, 1), strict=True)))
def test_a_linear_system_takes_one_jacobian(run, split, unknowns):
    """Two sweeps a step at most, then: one to see the residual and one to be rid of it."""
    result = run(oscillator(split), step=0.1)
    steps = result.attrs["steps_accepted"]
    assert result.attrs["iterations"] <= 2 * steps + unknowns


@pytest.mark.parametrize(
    "split", [splits[0], *(pytest.param(split, marks=pytest.mark.slow) for split in splits[1:])]
)
def test_error_control_meets_the_reference_value(run, split):
    """Reference: x1(2) = 0.44247647."""
    exact = closed_form(np.array([0.0, end]))[-1, 0]
    assert exact == pytest.approx(0.44247647, abs=5e-9)
    result = run(oscillator(split), tolerance=1e-6)
    assert result.attrs["simulated_time"] == end
    # The errors of single steps alternate; what is left of them is a fraction of the tolerance.
    assert result["first.displacement"].to_numpy()[-1] == pytest.approx(exact, abs=1e-6)
