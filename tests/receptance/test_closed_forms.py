"""Receptances of tracks that have a closed form."""

from dataclasses import replace

import numpy as np
import pytest

from railcosim.receptance.dynamic_stiffness import DynamicStiffness
from railcosim.receptance.points import Place, track_point
from track_fmu.parameters import TrackParameters

TABLE1 = TrackParameters()


def receptance(parameters, frequencies, load, response=None):
    track = DynamicStiffness(parameters)
    points = [track_point(parameters, place) for place in (load, response or load)]
    return track.receptance(np.asarray(frequencies), load=points[0], response=points[1])


def support_stiffness(parameters, omega):
    """Dynamic stiffness of pad, sleeper and ballast in series [N/m]."""
    pad = parameters.pad_stiffness + 1j * omega * parameters.pad_damping
    bed = parameters.ballast_stiffness + 1j * omega * parameters.ballast_damping
    bed = bed - omega**2 * parameters.sleeper_mass
    return pad * bed / (pad + bed)


def infinite_beam(parameters, frequency):
    """Receptance of an infinite Timoshenko beam on the same supports, smeared.

    Residues of the Fourier integral over the wave number k: with the stiffness K of the bed per
    length, ``w = (EI p + S) / D(p)`` and ``D = (EI p + S)(kAG p + K') - (kAG)^2 p`` in ``p = k^2``.
    """
    omega = 2 * np.pi * frequency
    bending, shear = parameters.bending_stiffness, parameters.shear_stiffness
    turning = shear - omega**2 * parameters.rotary_inertia_per_length
    bed = support_stiffness(parameters, omega) / parameters.sleeper_spacing
    bed = bed - omega**2 * parameters.mass_per_length
    quadratic = [bending * shear, bending * bed + turning * shear - shear**2, turning * bed]
    first, second = np.roots(quadratic)
    total = 0.0
    for pole, other in ((first, second), (second, first)):
        number = np.sqrt(pole + 0j)
        number = number if number.imag > 0 else -number
        total += 1j * (bending * pole + turning) / (2 * number * (pole - other) * quadratic[0])
    return total


def test_the_infinite_beam_is_winklers_when_it_is_stiff_in_shear():
    """``lambda / 2 k`` with ``lambda = (k / 4 EI)^(1/4)``."""
    stiff = replace(TABLE1, shear_stiffness=1e14)
    bed = support_stiffness(stiff, 0.0).real / stiff.sleeper_spacing
    winkler = (bed / (4 * stiff.bending_stiffness)) ** 0.25 / (2 * bed)
    assert infinite_beam(stiff, 0.0).real == pytest.approx(winkler, rel=1e-6)


def smeared(spacing):
    """The track of Table 1 with other sleepers that make the same bed per length."""
    share = spacing / TABLE1.sleeper_spacing
    scaled = (
        "pad_stiffness",
        "pad_damping",
        "sleeper_mass",
        "ballast_stiffness",
        "ballast_damping",
    )
    return replace(
        TABLE1,
        bays=round(32.5 / spacing),
        elements_per_bay=2,
        sleeper_spacing=spacing,
        **{name: share * getattr(TABLE1, name) for name in scaled},
    )


@pytest.mark.parametrize("frequency", [0.0, 30.0, 64.0, 150.0, 258.0, 300.0])
def test_close_supports_are_a_continuous_bed(frequency):
    """Of 8 sleepers in 0.65 m; higher up, what the ends of the track reflect comes to matter."""
    track = smeared(0.65 / 8)
    middle = Place(position=track.length / 2)
    value = receptance(track, [frequency], middle)[0]
    assert abs(value / infinite_beam(track, frequency) - 1.0) < 1e-3


def test_supports_become_a_continuous_bed_with_the_square_of_their_spacing():
    expected = infinite_beam(TABLE1, 258.0)
    errors = []
    for parts in (2, 4):
        track = smeared(0.65 / parts)
        above = Place(position=track.sleeper_spacing * (track.bays // 2))
        errors.append(abs(receptance(track, [258.0], above)[0] / expected - 1.0))
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.5)


@pytest.mark.parametrize("frequency", [0.0, 64.0, 258.0, 955.0])
def test_a_rail_without_stiffness_and_mass_leaves_one_support(frequency):
    """Pad and ballast in series, with the sleeper between them; rail 1e-7 of the pad."""
    soft = replace(
        TABLE1,
        bays=4,
        bending_stiffness=1e-3,
        shear_stiffness=1e-3,
        mass_per_length=1e-9,
        rotary_inertia_per_length=0.0,
    )
    omega = 2 * np.pi * frequency
    rail, sleeper = Place(position=2 * soft.sleeper_spacing), Place(sleeper=2)
    above = receptance(soft, [frequency], rail)[0]
    assert above * support_stiffness(soft, omega) == pytest.approx(1.0, abs=1e-6)
    bed = soft.ballast_stiffness + 1j * omega * soft.ballast_damping - omega**2 * soft.sleeper_mass
    assert receptance(soft, [frequency], rail, sleeper)[0] * bed == pytest.approx(1.0, abs=1e-6)
    assert receptance(soft, [frequency], sleeper)[0] * bed == pytest.approx(1.0, abs=1e-6)
