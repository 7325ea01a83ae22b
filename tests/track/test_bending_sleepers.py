"""A track on sleepers that bend: against rigid ones, the assembled matrices and equilibrium."""

import numpy as np
import pytest
from scipy.integrate import simpson
from scipy.sparse.linalg import spsolve

from track_fmu.ballast import PolynomialBallast
from track_fmu.beam_element import deflection_shape, shear_parameter
from track_fmu.sleeper import half_sleeper
from track_fmu.sleeper_observation import sleeper_operators

from .reference import STATIC_LOAD, Track, one_wheel

SHORT = {"bays": 8, "elements_per_bay": 4}
BEAM = {**SHORT, "sleeper": "beam", "sleeper_elements": 5}
SPEED = 40.0 / 3.6


@pytest.fixture(scope="module")
def bending():
    """Eight bays on sleepers that bend, with 120 of 139 pairs of modes."""
    return Track(120, **BEAM)


def stiffened(factor):
    """The same, with sleepers that are so many times as stiff."""
    return Track(
        100,
        **BEAM,
        sleeper_bending_stiffness=factor * 5.5e6,
        sleeper_shear_stiffness=factor * 565e6,
    )


def passage(track):
    """Deflections and forces while a pulsating wheel crosses a sleeper, on an equal footing."""
    model = one_wheel(track, ballast=PolynomialBallast(), initial_speed=SPEED)
    position, step = np.array([2.4]), 1e-4
    model.start(position, np.array([STATIC_LOAD]))
    seen = []
    for k in range(1, 301):
        position = position + SPEED * step
        model.step(step, position, np.array([STATIC_LOAD * (1.0 + 0.5 * np.sin(0.1 * k))]))
        now = model.observe()
        rail = model.rail_displacement * 1e8
        seen.append(np.concatenate((rail, now.sleeper_displacement * 1e8, now.ballast_force)))
    return np.array(seen)  # 1 mm as 100 kN


def test_sleepers_that_do_not_bend_give_the_passage_over_rigid_ones():
    """What is left of the bending goes down as its inverse stiffness does."""
    rigid = passage(Track(69, **SHORT))
    scale = np.abs(rigid).max()
    differences = [np.abs(passage(stiffened(f)) - rigid).max() / scale for f in (1, 50, 200)]
    assert differences[0] > 0.03
    assert differences[1] / differences[2] == pytest.approx(4.0, rel=0.05)
    assert differences[2] < 1e-3


def test_force_on_rigid_sleepers_is_the_law_of_their_displacement():
    """The weights of the spread force add up to one: a rigid motion has the law as it is."""
    half = half_sleeper(Track(10, **BEAM).parameters)
    rigid_motion = np.zeros(half.size)
    rigid_motion[[0, *range(1, half.size, 2)]] = 0.4e-3
    assert half.spread @ rigid_motion == pytest.approx(0.4e-3, rel=1e-14)


def test_static_equilibrium_and_moments_of_every_sleeper(bending):
    """Pads carry what the beds carry; moments from the pressure on the outer part of a sleeper."""
    model = one_wheel(bending, ballast=PolynomialBallast(), supports_per_wheel=7)
    model.start(np.array([2.5]), np.array([STATIC_LOAD]))
    now, parameters = model.observe(), bending.parameters
    assert now.pad_force == pytest.approx(now.ballast_force, rel=1e-9, abs=1e-3)
    half = half_sleeper(parameters)
    at, moments = 3, np.array([now.sleeper_moment, now.sleeper_centre_moment])
    increment = PolynomialBallast().force(now.ballast_deformation, np.zeros(7), np.arange(7))[at]
    load = np.zeros(half.size)
    load[half.seat] = now.pad_force[at]
    bed = parameters.ballast_stiffness
    bent = np.linalg.solve(half.stiffness + bed * half.bed, load - increment * half.spread)
    assert bent[half.seat] == pytest.approx(now.sleeper_displacement[at], rel=1e-9)
    # deflections between the nodes by their cubics, pressures and their moments by Simpson's rule
    nodes = np.array([0.0, *np.cumsum(np.full(5, 0.25))])
    fine, weight = deflections(parameters, nodes, bent), deflections(parameters, nodes, bent=None)
    x = np.linspace(0.0, 1.25, len(fine))
    pressure = bed / 1.25 * fine + increment * weight**2 / simpson(weight**2, x)
    assert simpson(pressure, x) == pytest.approx(now.ballast_force[at], rel=1e-6)
    outer = x >= 0.75 - 1e-9
    expected = [
        simpson(pressure[outer] * (x[outer] - 0.75), x[outer]),
        simpson(pressure * x, x) - 0.75 * now.pad_force[at],
    ]
    assert moments[:, at] == pytest.approx(expected, rel=2e-6)


def deflections(parameters, nodes, bent):
    """Deflection of half a sleeper at 401 places; under a load on a loaded bed if none is given."""
    half = half_sleeper(parameters)
    if bent is None:
        load = np.zeros(half.size)
        load[half.seat] = 1.0
        bed = 4.0 * parameters.ballast_stiffness
        bent = np.linalg.solve(half.stiffness + bed * half.bed, load)
    ends, length = np.insert(bent, 1, 0.0), nodes[1]
    phi = shear_parameter(parameters.sleeper_section, length)
    found = []
    for place in np.linspace(0.0, nodes[-1], 401):
        n = min(int(place / length), len(nodes) - 2)
        found.append(deflection_shape(place / length - n, length, phi) @ ends[2 * n : 2 * n + 4])
    return np.array(found)


@pytest.mark.parametrize("frequency", [20.0, 130.0, 400.0, 650.0, 1000.0])
def test_harmonic_response_of_sleepers_is_that_of_the_matrices(bending, frequency):
    """Seat displacement, moments and mean deflection, of modes and residual flexibility."""
    matrices, reduced = bending.matrices, bending.reduced
    omega = 2.0 * np.pi * frequency
    node = 18  # of the rail, in the middle of bay 5
    force = np.zeros(matrices.numbering.size)
    force[matrices.numbering.rail[node, 0]] = 1.0
    dynamic = matrices.stiffness + 1j * omega * matrices.damping - omega**2 * matrices.mass
    motion = spsolve(dynamic.tocsc(), force)
    operators = sleeper_operators(bending.parameters, matrices)
    direct = operators.static @ motion + 1j * omega * (operators.viscous @ motion)
    direct = direct - omega**2 * (operators.inertial @ motion)
    rows = np.vstack([reduced.sleeper_shape, seat_rows(reduced, reduced.shape)])
    residual = np.vstack([reduced.sleeper_flexibility, seat_rows(reduced, reduced.flexibility)])
    load = reduced.shape[2 * node]
    modal = rows @ (load / (1j * omega - reduced.eigenvalues))
    modal += np.conj(rows) @ np.conj(load / (-1j * omega - reduced.eigenvalues))
    modal += residual[:, 2 * node]
    expected = np.concatenate((direct, motion[matrices.numbering.sleeper]))
    cut_off = abs(reduced.eigenvalues[-1])
    for found, wanted in zip(np.split(modal, 4), np.split(expected, 4), strict=True):
        # the cut modes are quasi-static up to (omega / cut-off)^2 of their share; the velocities
        # in a moment, damping times them, lack their linear share
        limit = 0.1 * (omega / cut_off) ** 2 + 1e-3 * omega / cut_off
        assert np.abs(found - wanted).max() < limit * np.abs(wanted).max()


def seat_rows(reduced, rows):
    return rows[reduced.seat_rows] - rows[reduced.pad_rows]
