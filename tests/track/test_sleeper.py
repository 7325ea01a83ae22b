"""Half a sleeper by itself: frequencies, elastic foundation and statics in closed form."""

import numpy as np
import pytest
import scipy.linalg as la
from scipy.optimize import brentq

from track_fmu.parameters import TrackParameters
from track_fmu.sleeper import half_sleeper, sleeper_nodes

BEAM = TrackParameters(sleeper="beam")
# next to no shear and no rotary inertia: Euler and Bernoulli's beam
SLENDER = {"sleeper_shear_stiffness": 5e12, "sleeper_rotary_inertia_per_length": 0.0}


def frequencies(bed=0.0, **values):
    """Natural frequencies of the half sleeper on a bed [rad/s], the lowest first."""
    half = half_sleeper(TrackParameters(sleeper="beam", **values))
    squares = la.eigh(half.stiffness + bed * half.bed, half.mass, eigvals_only=True)
    return np.sqrt(np.maximum(squares, 0.0))


def timoshenko_frequencies(count, bed=0.0):
    """Symmetric frequencies of a free-free Timoshenko beam on a bed [rad/s].

    About the centre ``w = W cos(k x)`` and ``theta = T sin(k x)`` fulfil ``kAG (w'' - theta') +
    (m omega^2 - s) w = 0`` and ``EI theta'' + kAG (w' - theta) + m r^2 omega^2 theta = 0`` with two
    values of ``k^2``; at the end ``theta' = 0`` and ``w' = theta``.
    """
    section, length = BEAM.sleeper_section, BEAM.sleeper_half_length
    ei, kag = section.bending_stiffness, section.shear_stiffness

    def determinant(omega):
        load = section.mass_per_length * omega**2 - bed / length
        turn = section.rotary_inertia_per_length * omega**2
        squares = np.roots([kag * ei, -(kag * turn + ei * load), load * (turn - kag)])
        wave = np.sqrt(squares.astype(complex))
        couple = (load / kag - squares) * np.cos(wave * length)
        shear = load / kag * np.sin(wave * length) / wave
        return np.real(
            (couple[0] * shear[1] - couple[1] * shear[0]) / (squares[0] - squares[1] + 0j)
        )

    grid = np.arange(10.3, 3e4, 5.0)
    signs = np.sign([determinant(omega) for omega in grid])
    places = np.flatnonzero(signs[:-1] != signs[1:])[:count]
    return np.array([brentq(determinant, grid[k], grid[k + 1], xtol=1e-9) for k in places])


def test_free_frequencies_are_those_of_euler_and_bernoulli_where_shear_is_none():
    """``(beta L)^2 sqrt(EI / m L^4)`` with the symmetric ones of the known ``beta L``."""
    section = BEAM.sleeper_section
    expected = np.array([4.730041, 10.995608, 17.278760]) ** 2 / (2 * BEAM.sleeper_half_length) ** 2
    expected *= np.sqrt(section.bending_stiffness / section.mass_per_length)
    found = frequencies(sleeper_elements=20, **SLENDER)
    assert found[0] < 1e-3 * found[1]  # it moves freely as a whole
    assert found[1:4] == pytest.approx(expected, rel=2e-5)
    assert expected[0] / (2 * np.pi) == pytest.approx(133.6, abs=0.1)


def test_free_frequencies_converge_to_those_of_timoshenko_with_second_order():
    expected = timoshenko_frequencies(3)
    assert expected / (2 * np.pi) == pytest.approx([130.7, 647.6, 1419.2], abs=0.1)
    # equal elements, on either side of the rail seat at 3/5 of the half length
    errors = np.array([frequencies(sleeper_elements=n)[1:4] / expected - 1.0 for n in (5, 10, 20)])
    assert (errors > 0.0).all()  # of a consistent mass
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(2.0, abs=0.1)
    as_by_default = frequencies()[1:4] / expected - 1.0
    assert (as_by_default < [2e-4, 4e-3, 1.5e-2]).all()


@pytest.mark.parametrize("bed", [1e6, 30e6, 300e6])
def test_frequencies_on_an_elastic_foundation(bed):
    """The lowest is that of the whole sleeper moving as one: an even bed bends it not at all."""
    expected = timoshenko_frequencies(4, bed)
    found = frequencies(bed, sleeper_elements=20)[:4]
    assert found[0] == pytest.approx(np.sqrt(bed / 125.0), rel=1e-9)
    assert found[0] == pytest.approx(expected[0], rel=1e-9)
    assert (abs(found / expected - 1.0) < [1e-9, 2e-5, 5e-4, 2.2e-3]).all()


def hetenyi(load, bed):
    """Deflection at the rail seat and moments there and at the centre, of a beam on Winkler's bed.

    M. Hetenyi, Beams on Elastic Foundation (1946): products of sines and hyperbolic sines of
    ``beta x``, even about the centre, another set beyond the load; the end is free.
    """
    ei, end, seat = 5.5e6, BEAM.sleeper_half_length, BEAM.sleeper_rail_seat
    beta = (bed / end / (4.0 * ei)) ** 0.25
    waves = beta * np.array([1 + 1j, 1 - 1j, -1 + 1j, -1 - 1j])

    def row(x, order):
        return waves**order * np.exp(waves * x)

    nothing = np.zeros(4)
    matrix = np.array(
        [
            [*row(0.0, 1), *nothing],
            [*row(0.0, 3), *nothing],
            *[[*row(seat, order), *-row(seat, order)] for order in range(4)],
            [*nothing, *row(end, 2)],
            [*nothing, *row(end, 3)],
        ]
    )
    right = np.zeros(8)
    right[5] = -load / ei  # the third derivative grows by P / EI where the load stands
    inner = np.linalg.solve(matrix, right)[:4]
    return (
        np.real(row(seat, 0) @ inner),
        np.real(-ei * row(seat, 2) @ inner),
        np.real(-ei * row(0.0, 2) @ inner),
    )


def test_deflection_and_moments_of_a_loaded_sleeper_are_hetenyis():
    load, bed = 50e3, 90e6
    deflection, at_seat, at_centre = hetenyi(load, bed)
    half = half_sleeper(TrackParameters(sleeper="beam", sleeper_elements=20, **SLENDER))
    force = np.zeros(half.size)
    force[half.seat] = load
    displacement = np.linalg.solve(half.stiffness + bed * half.bed, force)
    moments = (half.moment_stiffness + bed * half.moment_bed) @ displacement
    # EI / kAG L^2 = 7e-7 of shear is left in the slender beam
    assert displacement[half.seat] == pytest.approx(deflection, rel=3e-6)
    assert moments == pytest.approx([at_seat, at_centre], rel=1e-5)
    assert at_seat > 0.0 > at_centre
    assert bed * half.mean @ displacement == pytest.approx(load, rel=1e-9)


def test_an_evenly_spread_load_sinks_a_sleeper_without_bending_it():
    bed = 30e6
    half = half_sleeper(BEAM)
    displacement = np.linalg.solve(half.stiffness + bed * half.bed, 1e4 * half.mean)
    assert displacement[[0, *range(1, half.size, 2)]] == pytest.approx(1e4 / bed, rel=1e-9)


def test_a_sleeper_weighs_and_rests_as_much_as_a_rigid_one():
    half = half_sleeper(BEAM)
    lifted = np.zeros(half.size)
    lifted[[0, *range(1, half.size, 2)]] = 1.0
    assert lifted @ half.mass @ lifted == pytest.approx(125.0, rel=1e-12)
    assert lifted @ half.bed @ lifted == pytest.approx(1.0, rel=1e-12)
    assert half.mean @ lifted == pytest.approx(1.0, rel=1e-12)
    assert abs(half.stiffness @ lifted).max() < 1e-12 * half.stiffness.max()


@pytest.mark.parametrize(
    ("seat", "elements", "inner"), [(0.75, 5, 3), (0.75, 8, 5), (0.1, 2, 1), (1.2, 4, 3)]
)
def test_a_node_is_at_the_rail_seat_and_elements_are_alike(seat, elements, inner):
    nodes, place = sleeper_nodes(1.25, seat, elements)
    assert (len(nodes), place) == (elements + 1, inner)
    assert nodes[[0, place, -1]] == pytest.approx([0.0, seat, 1.25])
    assert (np.diff(nodes) > 0.0).all()


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"sleeper": "twin block"}, "sleeper is 'twin block'; it must be 'rigid' or 'beam'"),
        ({"sleeper_rail_seat": 1.3}, "must be less than sleeper_half_length = 1.25 m"),
        ({"sleeper_elements": 1}, "sleeper_elements = 1 must be a whole number of at least 2"),
        ({"sleeper_bending_stiffness": 0.0}, "sleeper_bending_stiffness = 0.0 must be greater"),
    ],
)
def test_impossible_sleepers_are_refused_in_a_sentence(values, sentence):
    with pytest.raises(ValueError, match=sentence):
        TrackParameters(**values)
