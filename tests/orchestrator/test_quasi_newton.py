"""The solver of z = G(z) by itself."""

import numpy as np
import pytest

from orchestrator.decision import Cause, Failure
from orchestrator.quasi_newton import FixedPoint, broyden


class Problem:
    """Counts the evaluations of a map."""

    def __init__(self, function, size, **options):
        self.function = function
        self.count = 0
        self.equations = FixedPoint(
            **{
                "names": [f"z{n}" for n in range(size)],
                "nominal": np.ones(size),
                "lower": np.full(size, -np.inf),
                "upper": np.full(size, np.inf),
                "tolerance": 1e-10,
                "max_iterations": 20,
                **options,
            }
        )

    def evaluate(self, z):
        self.count += 1
        self.last = z.copy()
        self.result = np.asarray(self.function(z), dtype=float)

    def solve(self, start, inverse=None, guess=None):
        return self.equations.solve(
            self.evaluate, lambda: self.result, np.array(start), inverse, guess
        )


def test_a_linear_map_takes_one_jacobian_and_one_step():
    matrix = np.random.default_rng(1).normal(size=(4, 4))
    problem = Problem(lambda z: matrix @ z + 1.0, 4)
    solution = problem.solve(np.zeros(4))
    exact = np.linalg.solve(np.eye(4) - matrix, np.ones(4))
    assert problem.last == pytest.approx(exact, abs=1e-8)
    # First residual, four differences, one step; one more since differences are not exact.
    assert solution.evaluations == problem.count <= 7
    assert solution.residual_norm <= 1e-10


def test_knowledge_of_the_jacobian_saves_evaluations():
    problem = Problem(lambda z: -2.0 * z + 3.0, 1)
    first = problem.solve([0.0])
    second = problem.solve([5.0], first.inverse)
    assert problem.last == pytest.approx([1.0], abs=1e-10)
    assert second.evaluations <= 3
    assert first.inverse == pytest.approx(np.array([[-1.0 / 3.0]]), rel=1e-6)


def test_the_start_and_the_inverse_given_stay_as_they_were():
    start, inverse = np.array([5.0, 1.0]), -np.eye(2)
    kept = inverse.copy()
    problem = Problem(lambda z: [np.cos(z[1]), np.sin(z[0])], 2)
    solution = problem.solve(start, inverse)
    assert solution.failure is None
    assert np.array_equal(inverse, kept)
    assert np.array_equal(start, [5.0, 1.0])


def test_one_unknown_converges_like_the_secant_rule():
    sizes = []
    problem = Problem(lambda z: z - (z**3 - 2.0), 1)
    original = problem.evaluate

    def recording(z):
        sizes.append(abs(z[0] - 2.0 ** (1.0 / 3.0)))
        return original(z)

    problem.evaluate = recording
    problem.solve([1.5], np.array([[-1.0 / 6.0]]))
    ratios = [
        new / (old * before)
        for before, old, new in zip(sizes[:3], sizes[1:4], sizes[2:5], strict=True)
    ]
    # e(n+1) = e(n) e(n-1) f''/(2 f') with f''/(2 f') = 1/z = 0.79 at the root.
    assert ratios[-1] == pytest.approx(2.0 ** (-1.0 / 3.0), rel=0.15)


def test_a_contact_law_is_solved_from_both_sides():
    def contact(z):
        return [3.0 * max(1.0 - z[0], 0.0) ** 1.5]

    for start in (-2.0, 0.0, 5.0):
        problem = Problem(contact, 1)
        assert problem.solve([start]).failure is None
        assert problem.last == pytest.approx(contact(problem.last), abs=1e-10)


def test_bounds_are_kept_on_the_way():
    seen = []
    problem = Problem(lambda z: seen.append(z[0]) or [np.sqrt(z[0])], 1, lower=np.zeros(1))
    assert problem.solve([0.3]).failure is None
    assert min(seen) >= 0.0
    above = Problem(lambda z: [0.5 * z[0] + 0.5], 1, upper=np.ones(1))
    assert above.solve([1.0]).evaluations == 1


def test_scales_do_not_matter():
    scale = np.array([1e-3, 1e5])

    def scaled(z):
        a, b = z / scale
        return scale * np.array([0.3 * np.cos(b), 1.0 + 0.5 * np.sin(3.0 * a)])

    problem = Problem(scaled, 2, nominal=scale)
    solution = problem.solve([0.0, 0.0])
    assert solution.failure is None
    assert (problem.last - scaled(problem.last)) / scale == pytest.approx([0.0, 0.0], abs=1e-10)


def test_giving_up_names_the_worst_unknown():
    problem = Problem(lambda z: [z[0] + 1.0 + z[0] ** 2, 0.0], 2, names=["easy", "other"])
    failure = problem.solve([1.0, 0.0]).failure
    assert failure.cause is Cause.CONVERGENCE
    assert "easy" in failure.message


def test_no_solution_at_all_is_said_so():
    failure = Problem(lambda z: z + 1.0, 1).solve([0.0]).failure
    assert failure.cause is Cause.CONVERGENCE
    assert "ran away" in failure.message or "singular" in failure.message


def test_the_update_satisfies_the_secant_equation_and_changes_nothing_else():
    random = np.random.default_rng(2)
    inverse, moved, change = (
        random.normal(size=(3, 3)),
        random.normal(size=3),
        random.normal(size=3),
    )
    updated = broyden(inverse, moved, change)
    assert updated @ change == pytest.approx(moved, abs=1e-12)
    # Good Broyden: the Jacobian itself changes only along the step.
    orthogonal = np.cross(moved, random.normal(size=3))
    difference = np.linalg.inv(updated) - np.linalg.inv(inverse)
    assert difference @ orthogonal == pytest.approx(np.zeros(3), abs=1e-10)


matrix = np.array([[0.5, 4.0, 0.0], [-0.2, -1.5, 2.0], [0.1, 0.0, 0.4]])
true_inverse = np.linalg.inv(matrix - np.eye(3))


def solved_with(guess, **options):
    problem = Problem(lambda z: matrix @ z + 1.0, 3, **options)
    solution = problem.solve(np.zeros(3), guess=guess)
    assert solution.failure is None
    exact = np.linalg.solve(np.eye(3) - matrix, np.ones(3))
    assert problem.last == pytest.approx(exact, abs=1e-8)
    assert solution.evaluations == problem.count
    return solution


def test_a_true_guess_saves_the_finite_differences():
    assert solved_with(None).evaluations == 1 + 3 + 2
    assert solved_with(lambda: true_inverse).evaluations == 2


@pytest.mark.parametrize(
    "guess",
    [
        true_inverse.T,
        -true_inverse,
        -np.eye(3),
        np.zeros((3, 3)),
        1e200 * true_inverse,
        np.full((3, 3), np.nan),
        0.9 * true_inverse,
    ],
    ids=["transposed", "wrong sign", "handing on", "zero", "huge", "not a number", "inaccurate"],
)
def test_a_wrong_guess_costs_evaluations_and_nothing_else(guess):
    kept = guess.copy()
    assert solved_with(lambda: guess, max_iterations=3).evaluations <= 1 + 3 + 3
    assert np.array_equal(guess, kept, equal_nan=True)


def test_a_guess_that_leads_where_nothing_can_be_computed_is_undone():
    problem = Problem(np.cos, 1)
    evaluate = problem.evaluate

    def within(z):
        return Failure(Cause.DISCARD, "too far") if abs(z[0]) > 2.0 else evaluate(z)

    problem.evaluate = within
    # The correction with this guess leads to z = -100.
    assert problem.solve([0.0], guess=lambda: np.array([[100.0]])).failure is None
    assert problem.last == pytest.approx([0.7390851332151607], abs=1e-9)


def test_what_is_known_counts_more_than_a_guess():
    def never():
        raise AssertionError("it was asked")

    problem = Problem(lambda z: -2.0 * z + 3.0, 1)
    assert problem.solve([0.0], np.array([[-1.0 / 3.0]]), never).evaluations == 2
    assert problem.solve([1.0], guess=never).evaluations == 1


def test_broyden_and_differences_take_over_from_a_guess():
    """Half of the true derivative contracts at first; the solution is the same to the tolerance."""
    problem = Problem(lambda z: [z[0] - (z[0] ** 3 - 2.0)], 1)
    solution = problem.solve([1.3], guess=lambda: np.array([[-1.0 / 9.0]]))
    assert problem.last == pytest.approx([2.0 ** (1.0 / 3.0)], abs=1e-9)
    assert solution.inverse == pytest.approx(-1.0 / (3.0 * 2.0 ** (2.0 / 3.0)), rel=1e-2)


def test_a_correction_that_makes_it_worse_is_undone():
    """Newton's iteration on arctan runs away from beyond 1.39; the wrong guess leads to z = 50."""
    problem = Problem(lambda z: z - np.arctan(z), 1)
    assert problem.solve([1.0], guess=lambda: np.array([[200.0 / np.pi]])).failure is None
    assert problem.last == pytest.approx([0.0], abs=1e-9)
