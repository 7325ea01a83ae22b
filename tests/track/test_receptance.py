"""Receptance of the track, direct and modal, and an independent two-layer benchmark."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from track_fmu.assembly import assemble
from track_fmu.contact_point import locate
from track_fmu.parameters import TrackParameters

from .reference import MIDSPAN, direct_receptance


def modal_receptance(reduced, frequency, position):
    point = locate(reduced.parameters, position)
    shape = point.shape @ reduced.shape[point.rows]
    omega = 2j * np.pi * frequency
    total = np.sum(shape**2 / (omega - reduced.eigenvalues))
    complex_pairs = reduced.weight == 2.0
    total += np.sum(
        np.conj(shape[complex_pairs]) ** 2 / (omega - np.conj(reduced.eigenvalues[complex_pairs]))
    )
    return total + point.shape @ reduced.flexibility[point.rows, point.rows] @ point.shape


@pytest.mark.parametrize(
    ("low", "high", "expected"), [(40, 90, 64.0), (200, 320, 258.0), (930, 980, 955.0)]
)
def test_resonances_of_the_unloaded_track_at_midspan(table1, low, high, expected):
    """About 60 Hz, about 250 Hz and above 900 Hz in the paper's Fig. 6."""
    peak = minimize_scalar(
        lambda f: -abs(table1.receptance(f, MIDSPAN)), bounds=(low, high), method="bounded"
    )
    assert peak.x == pytest.approx(expected, abs=1.0)


def test_static_flexibility_at_midspan(table1):
    assert table1.receptance(0.0, MIDSPAN).real == pytest.approx(16.84e-9, abs=0.005e-9)


@pytest.mark.parametrize("frequency", [0.0, 30.0, 64.0, 258.0, 700.0, 955.0, 1500.0])
def test_modal_receptance_with_residual_is_the_direct_one(table1, frequency):
    """150 pairs reach 2.7 kHz; what lies above is quasi-static up to (f / 2700 Hz)^2."""
    direct = table1.receptance(frequency, MIDSPAN)
    modal = modal_receptance(table1.reduced, frequency, MIDSPAN)
    static_part = table1.reduced.flexibility.max()
    tolerance = static_part * (frequency / 2700.0) ** 2 + 1e-9 * abs(direct)
    assert abs(modal - direct) < 1.2 * tolerance


def test_without_residual_the_static_flexibility_is_short(table1):
    short = modal_receptance(table1.without_residual(), 0.0, MIDSPAN)
    lack = 1.0 - short.real / table1.receptance(0.0, MIDSPAN).real
    assert 0.002 < lack < 0.05


# mobility [m/(s N)] of a hysteretic two-layer track at a support; benchmark values published with
# the open-source package rolland
TWO_LAYER = {
    20.00: 9.63598e-7,
    59.76: 3.30518e-6,
    250.61: 1.69982e-6,
    499.11: 1.33929e-5,
    1000.08: 3.22827e-6,
}


def two_layer_mobility(frequency, elements_per_bay):
    young, shear, area, inertia, density = 210e9, 81e9, 76.7e-4, 3038.3e-8, 7850.0
    parts = assemble(
        TrackParameters(
            bays=242,
            elements_per_bay=elements_per_bay,
            sleeper_spacing=0.60,
            bending_stiffness=young * inertia,
            shear_stiffness=0.4 * shear * area,
            mass_per_length=density * area,
            rotary_inertia_per_length=density * inertia,
            sleeper_mass=162.0,
        )
    )
    stiffness = parts.rail_stiffness * (1 + 0.02j)
    stiffness = stiffness + 300e6 * (1 + 0.25j) * (parts.pad_incidence @ parts.pad_incidence.T)
    beds = parts.ballast_incidence @ parts.ballast_incidence.T
    stiffness = stiffness + 50e6 * (1 + 1.0j) * beds
    dof = parts.numbering.rail[parts.numbering.support_node[120], 0]  # the middle one of 241
    mobility = direct_receptance(stiffness, 0.0 * parts.mass, parts.mass, frequency, dof)
    return abs(2 * np.pi * frequency * mobility)


@pytest.mark.parametrize(
    ("frequency", "tolerance"),
    # close to the pinned-pinned resonance 8 elements in a bay are 1.04 % off
    [(20.00, 1e-4), (59.76, 1e-4), (250.61, 1e-4), (499.11, 1e-3), (1000.08, 1.1e-2)],
)
def test_mobility_of_a_two_layer_track(frequency, tolerance):
    expected = TWO_LAYER[frequency]
    assert two_layer_mobility(frequency, 8) == pytest.approx(expected, rel=tolerance)


def test_mobility_near_the_pinned_pinned_resonance_converges_to_the_benchmark():
    errors = [two_layer_mobility(1000.08, n) / TWO_LAYER[1000.08] - 1.0 for n in (8, 16, 32)]
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.7)  # second order
    assert abs(errors[2]) < 1e-3
