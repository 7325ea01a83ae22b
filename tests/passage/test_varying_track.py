"""Supports that differ: by increments on the nominal modes, and by the matrices of the track.

The difference is 0.24 % of the static load where all supports are alike, with the same settings.
"""

import numpy as np
import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.support_values import support_properties
from track_fmu.parameters import TrackParameters

from .full_model import FullModel, haversine
from .reference_case import SPEED, STATIC_LOAD

BOUND = 0.005 * STATIC_LOAD
FLAT = 16.6
APPROACH, DEPARTURE = 1.5, 0.9
CASES = {
    "random pads and ballast": (
        "variation.pad_stiffness_deviation=0.3",
        "variation.ballast_stiffness_deviation=0.4",
        "variation.correlation_length=1.5",
    ),
    "transition": (
        "variation.transition_begin=16.0",
        "variation.transition_length=1.3",
        "variation.transition_factor=4",
    ),
    "missing pads": ("variation.missing_pads=26",),
    "hanging sleepers": ("variation.hanging_sleepers=25-26", "variation.hanging_gap=0.5e-3"),
    "sleeper masses": ("variation.sleeper_mass_deviation=0.3",),
    "moving ballast": ("track.ballast_mass=200",),
    "moving ballast under beams": ("track.sleeper=beam", "track.ballast_mass=100"),
}


def compared(keys, supports, departure=DEPARTURE):
    """Largest difference of the contact force from the full model's [N], and its peak."""
    way = (f"run.approach={APPROACH}", f"run.departure={departure}")
    every = (*way, *keys, f"track.supports_per_wheel={supports}", "master.tolerance=5e-4")
    scenario = read_scenario(None, every)
    own = support_properties(scenario)
    more = (own["sleeper_mass_factor"] - 1.0) * TrackParameters().sleeper_mass
    full = FullModel(
        pads=own["pad_stiffness_factor"],
        beds=own["ballast_stiffness_factor"],
        gaps=own["gap"],
        masses=more + scenario.track.ballast_mass,
        sleeper=scenario.track.sleeper,
    )
    expected = full.run(
        speed=SPEED,
        drop=lambda position: haversine(position - FLAT),
        start=FLAT - APPROACH,
        stop=FLAT + departure - 0.05,
        step=2.5e-5,
    )
    passage = run_passage(scenario, fmus="native")
    position = passage["wheel_position"].sel(wheel=1).to_numpy()
    force = passage["contact_force"].sel(wheel=1).to_numpy()
    ours = np.interp(expected.position, position, force)
    late = expected.position > FLAT - 1.2  # the full model starts its wheels from rest
    return np.abs(ours - expected.force)[late].max(), expected.force.max()


@pytest.mark.slow
@pytest.mark.parametrize("keys", CASES.values(), ids=CASES)
def test_contact_force_is_that_of_changed_matrices(keys):
    difference, peak = compared(keys, supports=12)
    assert difference < BOUND
    assert peak > 1.2 * STATIC_LOAD


def test_contact_force_is_that_of_changed_matrices_over_hanging_sleepers():
    """The gaps are closed under the leading wheel and open behind the bogie."""
    difference, peak = compared(CASES["hanging sleepers"], supports=12, departure=0.3)
    assert difference < BOUND
    assert peak > 1.2 * STATIC_LOAD
