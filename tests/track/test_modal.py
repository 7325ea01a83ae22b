"""Complex modes against the dense state-space solution, and the identities they must fulfil."""

import time

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.linalg import eigvals
from scipy.linalg.lapack import zgbtrf

from track_fmu.assembly import assemble
from track_fmu.eigensolver import EigenvalueError, solve_damped
from track_fmu.modal import compute_basis
from track_fmu.parameters import TrackParameters


def dense_eigenvalues(matrices):
    """All eigenvalues in the upper half plane, ascending modulus."""
    size = matrices.mass.shape[0]
    inverse = np.linalg.inv(matrices.mass.toarray())
    state = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-inverse @ matrices.stiffness.toarray(), -inverse @ matrices.damping.toarray()],
        ]
    )
    values = eigvals(state)
    values = values[values.imag >= -1e-9]
    return values[np.argsort(np.abs(values))]


@pytest.mark.parametrize(
    ("damping", "real"),
    [(31e3, 0), (150e3, 22)],
    ids=["Table 1", "overdamped"],
)
def test_eigenvalues_are_those_of_the_dense_solution(damping, real):
    matrices = assemble(TrackParameters(ballast_damping=damping))
    basis = compute_basis(matrices, mode_pairs=200)
    assert np.count_nonzero(basis.weight == 1.0) == real
    assert int(basis.weight.sum()) == 400
    expected = dense_eigenvalues(matrices)[: len(basis.eigenvalues)]
    # the dense solution of the unscaled state matrix is good to about 1e-10 itself
    left = np.sort_complex(np.round(basis.eigenvalues, 3))
    right = np.sort_complex(np.round(expected, 3))
    assert np.abs(left - right).max() < 2e-3  # the same set: nothing missing, nothing twice
    nearest = [np.abs(expected - value).min() / abs(value) for value in basis.eigenvalues]
    assert max(nearest) < 1e-9


def test_number_of_modes_below_given_frequencies(table1):
    matrices = table1.matrices
    frequencies = np.abs(compute_basis(matrices, mode_pairs=230).eigenvalues) / (2 * np.pi)
    counts = [int(np.count_nonzero(frequencies < limit)) for limit in (500, 1e3, 2e3, 3e3, 5e3)]
    assert counts == [80, 99, 130, 158, 212]


def test_both_normalisations_and_orthogonality(table1):
    """Eq. (11a), (11b) and (12), from the matrices A and B of Eq. (4) and (5)."""
    matrices, basis = table1.matrices, table1.basis
    modes, values = basis.modes, basis.eigenvalues
    mass, damping, stiffness = (
        m.toarray() for m in (matrices.mass, matrices.damping, matrices.stiffness)
    )
    zero = np.zeros_like(mass)
    a = np.block([[damping, mass], [mass, zero]])
    b = np.block([[stiffness, zero], [zero, -mass]])
    columns = np.vstack([modes, modes * values])
    for products, diagonal in (
        (columns.T @ a @ columns, np.ones_like(values)),
        (columns.T @ b @ columns, -values),
    ):
        scale = np.sqrt(np.abs(np.outer(diagonal, diagonal)))
        assert np.abs(products - np.diag(diagonal)).max() / scale.max() < 1e-9


def test_the_complete_set_has_no_velocity_jump_and_the_inverse_mass(short):
    """sum rho rho^T / a = 0 and sum lambda rho rho^T / a = M^-1 for all modes together."""
    weighted = short.basis.modes * short.basis.weight
    velocity = np.real(weighted @ short.basis.modes.T)
    inverse_mass = np.real((weighted * short.basis.eigenvalues) @ short.basis.modes.T)
    expected = np.linalg.inv(short.matrices.mass.toarray())
    assert np.abs(inverse_mass - expected).max() < 1e-8 * np.abs(expected).max()
    # a velocity per impulse, to be compared with that of the lightest degree of freedom
    assert np.abs(velocity).max() < 1e-8


@pytest.mark.parametrize("pairs", [0, 848])
def test_impossible_numbers_of_modes_are_refused(table1, pairs):
    with pytest.raises(ValueError, match=f"mode_pairs = {pairs} must lie between 1 and 847"):
        compute_basis(table1.matrices, mode_pairs=pairs)


def test_a_defective_pair_is_refused_and_not_returned():
    """One degree of freedom at exactly critical damping has no complete set of modes."""
    one = sp.csc_array(np.array([[1.0]]))
    with pytest.raises(EigenvalueError, match="damping"):
        solve_damped(one, 2.0 * one, one, one, mode_pairs=1)


@pytest.mark.parametrize(
    "values",
    [
        {"pad_stiffness": 1.6e9},
        {"pad_stiffness": 8e9},
        {  # a case with two modes whose eigenvalues agree to 2e-14
            "bays": 40,
            "pad_stiffness": 1.087e9,
            "pad_damping": 11012.8,
            "ballast_stiffness": 191.4e6,
            "ballast_damping": 11545.0,
            "sleeper_mass": 75.7,
        },
        {"pad_damping": 0.0, "ballast_damping": 0.0},
        {"ballast_damping": 1e9},
    ],
)
def test_stiff_undamped_and_crowded_tracks_have_all_their_modes(values):
    matrices = assemble(TrackParameters(**values))
    basis = compute_basis(matrices, mode_pairs=100)
    expected = dense_eigenvalues(matrices)[: len(basis.eigenvalues)]
    ours, theirs = (np.sort(np.abs(v)) for v in (basis.eigenvalues, expected))
    assert ours == pytest.approx(theirs, rel=1e-7)  # the dense solution loses digits here
    terms = [
        np.asarray(matrix @ basis.modes) * basis.eigenvalues**power
        for matrix, power in ((matrices.stiffness, 0), (matrices.damping, 1), (matrices.mass, 2))
    ]
    residual = np.abs(sum(terms)).max(axis=0) / np.abs(terms[0]).max(axis=0)
    assert residual.max() < 1e-6


def test_200_pairs_of_the_table_1_track_take_less_than_a_second_and_a_half(table1):
    durations = []
    for _ in range(3):  # the fastest of three: the machine may be busy
        start = time.perf_counter()
        compute_basis(table1.matrices, mode_pairs=200)
        durations.append(time.perf_counter() - start)
    assert min(durations) < 1.5


def count_inside(matrices, height):
    """Eigenvalues between the real axis and the given imaginary part, by the argument principle.

    The argument of det T(lambda) is followed around a rectangle; no step may turn it by more than
    one radian, or it is halved.
    """
    bands = [
        np.vstack([np.zeros((4, matrices.mass.shape[0])), symmetric_band(matrix)])
        for matrix in (matrices.stiffness, matrices.damping, matrices.mass)
    ]

    def argument(z):
        factors, pivots, _ = zgbtrf(bands[0] + z * bands[1] + z * z * bands[2], 4, 4)
        swaps = np.count_nonzero(pivots != np.arange(len(pivots)))
        return np.sum(np.angle(factors[8])) + np.pi * swaps

    def turn(start, stop, first, last):
        change = (last - first + np.pi) % (2 * np.pi) - np.pi
        if abs(change) < 1.0 and abs(stop - start) < 8.0:
            return change
        middle = 0.5 * (start + stop)
        between = argument(middle)
        return turn(start, middle, first, between) + turn(middle, stop, between, last)

    corners = [400.0, 400.0 + 1j * height, -3000.0 + 1j * height, -3000.0, 400.0]
    values = [argument(z) for z in corners]
    total = sum(
        turn(*points) for points in zip(corners, corners[1:], values, values[1:], strict=False)
    )
    return round(total / (2 * np.pi))


def symmetric_band(matrix):
    size = matrix.shape[0]
    band = np.zeros((9, size))
    for k in range(-4, 5):
        diagonal = matrix.diagonal(k)
        band[4 - k, max(k, 0) : max(k, 0) + len(diagonal)] = diagonal
    return band


def test_the_argument_principle_finds_no_mode_missing(table1):
    height = 2 * np.pi * 1200.0
    below = np.count_nonzero(table1.basis.eigenvalues.imag < height)
    assert 80 < below < 130
    assert count_inside(table1.matrices, height) == below


@pytest.mark.slow
def test_800_pairs_of_a_200_bay_track_take_less_than_half_a_minute_and_none_is_missing():
    matrices = assemble(TrackParameters(bays=200))
    start = time.perf_counter()
    basis = compute_basis(matrices, mode_pairs=800)
    assert time.perf_counter() - start < 30.0
    assert len(basis.eigenvalues) == 800
    # each is an eigenvalue: T(lambda) rho vanishes against its largest term
    terms = [
        np.asarray(matrix @ basis.modes) * basis.eigenvalues**power
        for matrix, power in ((matrices.stiffness, 0), (matrices.damping, 1), (matrices.mass, 2))
    ]
    residual = np.abs(sum(terms)).max(axis=0) / np.abs(terms[0]).max(axis=0)
    assert residual.max() < 1e-9
    # none is missing: the argument principle counts the eigenvalues inside a contour
    assert count_inside(matrices, height=2 * np.pi * 500.0) == np.count_nonzero(
        basis.eigenvalues.imag < 2 * np.pi * 500.0
    )
