"""Passages of the monolith over pads, ballast and supports that are not the paper's."""

from pathlib import Path

import numpy as np
import pytest

from railcosim.monolithic import solve
from railcosim.monolithic.course import course_of
from railcosim.monolithic.held_track import held_track
from railcosim.monolithic.jacobian import jacobian
from railcosim.monolithic.scenario_system import make_system
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.surfaces.tables import compose

EXAMPLES = Path(__file__).parents[2] / "examples"
STATIC_LOAD = 117_720.0
SHORT = (
    "track.bays=14",
    "flat.position=4.95",
    "run.approach=0.35",
    "run.departure=0.12",
    "vehicle.wheels=1",
    "track.supports_per_wheel=13",
)
DIFFERENT = (
    "variation.ballast_stiffness_deviation=0.4",
    "variation.pad_stiffness_deviation=0.3",
    "variation.correlation_length=1.5",
)
TRACKS = {
    "relaxing pads": (f"track.pad={EXAMPLES / 'pad.csv'}", "track.mode_pairs=100"),
    "random, does not pull": ("track.ballast_pulls=false", *DIFFERENT),
    "hanging, table": (
        f"track.ballast={EXAMPLES / 'ballast.csv'}",
        "variation.hanging_sleepers=7-8",
        "variation.hanging_gap=0.3e-3",
    ),
    "hyperbolic, missing": (
        "track.ballast=hyperbolic",
        "track.ballast_tangent_damping=true",
        "variation.missing_fastenings=7",
        "variation.missing_pads=6",
    ),
}


def built(scenario, model, form="hertz"):
    course = course_of(scenario, compose(scenario))
    return make_system(scenario, held_track(scenario), course, model=model, contact_form=form)


@pytest.mark.parametrize("form", ["hertz", "constraint"])
@pytest.mark.parametrize("model", ["modal", "full"])
def test_the_jacobian_is_the_derivative_with_what_pads_remember(model, form):
    keys = (*TRACKS["relaxing pads"], *DIFFERENT, *TRACKS["hanging, table"][1:])
    system, state = built(read_scenario(None, (*SHORT, *keys)), model, form)
    random = np.random.default_rng(4)
    state[system.parts[-1]] -= 500.0 * random.random(system.laws.memories)
    change = 1e-9 * system.scale * random.standard_normal(system.size)
    rates = (system.rates(1e-4, state + change) - system.rates(1e-4, state - change)) / 2.0
    if system.mass is not None:
        rates = system.mass @ rates
    expected = jacobian(system, 1e-4, state) @ change
    assert np.abs(rates - expected).max() < 1e-5 * np.abs(expected).max()
    remembered = system.parts[-1]
    limit = 1e-5 * np.abs(expected[remembered]).max()
    assert np.abs(rates[remembered] - expected[remembered]).max() < limit


@pytest.mark.parametrize("model", ["modal", "full"])
@pytest.mark.parametrize("keys", TRACKS.values(), ids=TRACKS)
def test_the_start_is_static(model, keys):
    """Modes left out do not follow the velocity of the track, and leave 0.2 N/s to relax."""
    scenario = read_scenario(None, (*SHORT, *keys, "vehicle.speed_kmh=0.1"))
    system, state = built(scenario, model)
    assert system.instant(0.0, state).forces.force[0] == pytest.approx(STATIC_LOAD, rel=1e-4)
    rates = system.rates(0.0, state)
    assert np.abs(rates[system.parts[-1]]).sum() < 1e-5 * STATIC_LOAD
    assert np.abs(rates[system.parts[2]]).max() < 1e-4 * STATIC_LOAD / 592.5


def test_ballast_that_does_not_pull_lets_sleepers_rise():
    passage = solve(
        read_scenario(
            None,
            (*SHORT, "run.departure=0.06", "run.approach=0.06", *TRACKS["random, does not pull"]),
        ),
        model="full",
    )
    weight = 9.81 * (125.0 + 60.0 * 0.65)
    assert float(passage["ballast_force"].min()) == pytest.approx(-weight, abs=1e-3)
    assert float(passage["sleeper_displacement"].min()) < -weight / 30e6


@pytest.mark.slow
@pytest.mark.parametrize("keys", TRACKS.values(), ids=TRACKS)
def test_fmus_with_all_supports_agree_with_changed_matrices(keys):
    """Increments on nominal modes against properties in the matrices, half a metre with a flat."""
    scenario = read_scenario(None, (*SHORT, *keys, "master.step=5e-5"))
    passage = run_passage(scenario, fmus="native")
    times = passage["time"].to_numpy()
    full = solve(scenario, model="full", times=times)
    ours, theirs = (item["contact_force"].sel(wheel=1).to_numpy() for item in (passage, full))
    assert theirs.max() > 1.5 * STATIC_LOAD
    assert np.abs(ours - theirs).max() < 0.005 * STATIC_LOAD
