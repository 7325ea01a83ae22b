import numpy as np
import pytest

from track_fmu.assembly import assemble, half_bandwidth, to_banded
from track_fmu.parameters import TrackParameters


def test_table_1_track_has_847_degrees_of_freedom_and_49_sleepers():
    matrices = assemble(TrackParameters())
    assert matrices.mass.shape == (847, 847)
    assert len(matrices.numbering.sleeper) == 49
    rail = matrices.numbering.rail
    numbers = np.concatenate([rail[1:-1].ravel(), matrices.numbering.sleeper])
    assert sorted(numbers) == list(range(847))
    assert (rail[[0, -1]] == -1).all()


@pytest.mark.parametrize(
    ("values", "width"),
    [
        ({"bays": 2, "elements_per_bay": 1}, 2),
        ({"bays": 3, "elements_per_bay": 2}, 4),
        ({}, 4),
        ({"bays": 4, "elements_per_bay": 2, "sleeper": "beam", "sleeper_elements": 3}, 10),
    ],
)
def test_bands_hold_the_whole_matrix(values, width):
    matrices = assemble(TrackParameters(**values))
    assert half_bandwidth(matrices.mass, matrices.damping, matrices.stiffness) == width
    for matrix in (matrices.mass, matrices.damping, matrices.stiffness):
        full, banded = matrix.toarray(), to_banded(matrix)
        assert np.allclose(full, full.T, rtol=1e-14, atol=0.0)
        rebuilt = sum(np.diag(banded[k, : len(full) - k], -k) for k in range(len(banded)))
        assert np.array_equal(rebuilt, np.tril(full))


def test_a_lifted_track_carries_the_sum_of_its_masses_and_ballast_springs():
    parameters = TrackParameters(bays=10)
    matrices = assemble(parameters)
    up = np.zeros(matrices.mass.shape[0])
    up[matrices.numbering.rail[1:-1, 0]] = 1.0
    up[matrices.numbering.sleeper] = 1.0
    sleepers = parameters.supports * parameters.sleeper_mass
    inner_rail = 60.0 * (parameters.length - parameters.element_length)
    total = up @ (matrices.mass @ up)
    # the two outermost elements move at one end only: between 0 and 1 of their mass
    assert sleepers + inner_rail - 60 * 0.08125 < total < sleepers + inner_rail + 60 * 0.08125
    inside = up.copy()
    inside[matrices.numbering.rail[[1, -2], 0]] = 0.0
    ballast = up @ (matrices.stiffness @ up) - up @ (matrices.rail_stiffness @ up)
    assert ballast == pytest.approx(parameters.supports * 30e6, rel=1e-12)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"bays": 1}, "bays = 1 must be a whole number of at least 2"),
        ({"pad_stiffness": -80e6}, "pad_stiffness = -80000000.0 must be greater than 0"),
        ({"sleeper_mass": float("nan")}, "sleeper_mass = nan must be a finite number"),
        ({"pad_damping": -1.0}, "pad_damping = -1.0 must be at least 0"),
    ],
)
def test_wrong_parameters_are_refused_in_a_sentence(values, sentence):
    with pytest.raises(ValueError, match=sentence):
        TrackParameters(**values)
