"""Sleepers that differ in mass, and ballast that moves along."""

from pathlib import Path

import numpy as np
import pytest

from railcosim.builds import usual_build
from railcosim.errors import InputError
from railcosim.monolithic import solve
from railcosim.monolithic.course import course_of
from railcosim.monolithic.held_track import held_track
from railcosim.monolithic.jacobian import jacobian
from railcosim.monolithic.scenario_system import make_system
from railcosim.monolithic.support_laws import support_laws
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.surfaces.tables import compose

EXAMPLES = Path(__file__).parents[2] / "examples"
SMALL = ("track.bays=10", "flat.position=3.6", "run.approach=0.055", "run.departure=0.005")
ONE = (*SMALL, "vehicle.wheels=1")
GROWING = ("track.ballast_mass=40", "track.ballast_mass_grows=true")
DIFFERENT = ("variation.sleeper_mass_deviation=0.3", "variation.pad_stiffness_deviation=0.2")
STATIC_LOAD = 117_720.0
SUPPORTS = 9


def solved(*keys, model="full"):
    return solve(read_scenario(None, (*ONE, *keys)), model=model)


def built(*keys, model="full", form="hertz"):
    scenario = read_scenario(None, (*ONE, *keys))
    course = course_of(scenario, compose(scenario))
    return make_system(scenario, held_track(scenario), course, model=model, contact_form=form)


def shaken(system, state):
    """Put rail and sleepers in motion."""
    scale = system.scale[system.parts[0]]
    state[system.parts[0]] += 1e-5 * scale * np.random.default_rng(3).standard_normal(len(scale))
    return state


@pytest.mark.parametrize("model", ["modal", "full"])
def test_heavier_sleepers_everywhere_are_another_track(tmp_path, model):
    table = tmp_path / "supports.csv"
    rows = "".join(f"{i},1.6\n" for i in range(1, SUPPORTS + 1))
    table.write_text(f"number,sleeper_mass_factor\n{rows}")
    ours = solved(f"track.supports={table}", model=model)
    theirs = solved("track.sleeper_mass=200", model=model)
    light = solved(model=model)
    for name in ("contact_force", "ballast_force", "pad_force"):
        same, other = theirs[name].to_numpy(), light[name].to_numpy()
        # rounding may lead the integrator to other steps
        assert np.abs(ours[name].to_numpy() - same).max() < 1e-5 * STATIC_LOAD, name
        assert np.abs(other - same).max() > 1e-3 * STATIC_LOAD, name


@pytest.mark.parametrize("model", ["modal", "full"])
def test_ballast_that_moves_along_weighs_as_sleepers_do(model):
    """But the force on it has its inertia: Newton's law of the nominal sleeper."""
    ours = solved("track.ballast_mass=80", model=model)
    theirs = solved("track.sleeper_mass=205", model=model)
    force = (ours["contact_force"] - theirs["contact_force"]).to_numpy()
    assert np.abs(force).max() < 1e-5 * STATIC_LOAD
    shift = (ours["ballast_force"] - theirs["ballast_force"]).to_numpy()
    net = (ours["pad_force"] - ours["ballast_force"]).to_numpy()
    assert np.abs(shift).max() > 1e-3 * STATIC_LOAD
    # m a and M a; what the truncated modes lack is in the modal net force as well
    assert np.abs(shift - 80.0 / 125.0 * net).max() < (1e-4 if model == "full" else 0.02) * (
        np.abs(shift).max()
    )


@pytest.mark.parametrize("pads", [(), (f"track.pad={EXAMPLES / 'pad.csv'}",)])
def test_growing_ballast_obeys_its_law(pads):
    """``e(x) + d(x) x' + m(x) x'' + m_x x'^2 / 2`` on every sleeper, and Newton's law of that."""
    system, state = built(*GROWING, *DIFFERENT, *pads)
    state = shaken(system, state)
    now, rates = system.instant(0.0, state), system.rates(0.0, state)
    track, base, part = system.track, system.laws.base, system.parts[0]
    beds = slice(1, 1 + SUPPORTS)
    x = now.displacement[beds]
    v, a = ((track.supports.rate @ of)[:SUPPORTS] for of in (state[part], rates[part]))
    own = -now.forces.force
    borne = (
        base.ballast_stiffness * x + base.ballast_damping * v + base.ballast_mass * a + own[beds]
    )
    pressed = np.maximum(x, 0.0)
    growth = pressed * (0.37e12 + pressed * (-2.47e15 + pressed * 5.75e18)) / 30e6
    slope = (x > 0.0) * (0.37e12 + pressed * (-2 * 2.47e15 + pressed * 3 * 5.75e18)) / 30e6
    slow = (1.0 + growth) * (30e6 * x + 31e3 * v)
    expected = slow + 40.0 * ((1.0 + growth) * a + 0.5 * slope * v**2)
    assert borne == pytest.approx(expected, rel=1e-9, abs=1e-6 * np.abs(expected).max())
    assert np.abs(expected - slow).max() > 0.01 * np.abs(slow).max()


@pytest.mark.parametrize("form", ["hertz", "constraint"])
@pytest.mark.parametrize("pads", [(), (f"track.pad={EXAMPLES / 'pad.csv'}",)])
def test_the_jacobian_is_the_derivative_with_growing_ballast(form, pads):
    system, state = built(*GROWING, *DIFFERENT, *pads, form=form)
    state = shaken(system, state)
    change = 1e-9 * system.scale * np.random.default_rng(4).standard_normal(system.size)
    rates = (system.rates(1e-4, state + change) - system.rates(1e-4, state - change)) / 2.0
    rates = system.mass @ rates
    expected = jacobian(system, 1e-4, state) @ change
    assert np.abs(rates - expected).max() < 1e-5 * np.abs(expected).max()


def test_mass_that_grows_on_linear_ballast_is_constant():
    ours, theirs = (
        solved("track.ballast=linear", "track.ballast_mass=40", *more)
        for more in (("track.ballast_mass_grows=true",), ())
    )
    for name in ("contact_force", "ballast_force"):
        difference = (ours[name] - theirs[name]).to_numpy()
        assert np.abs(difference).max() < 1e-8 * STATIC_LOAD, name


def test_slope_and_curvature_are_derivatives_of_the_mass():
    scenario = read_scenario(None, (*ONE, *GROWING, "track.ballast=hyperbolic"))
    moving = support_laws(scenario, scenario.track, all_in_matrices=True).moving
    x, step = np.linspace(0.02e-3, 0.3e-3, SUPPORTS), 1e-8
    here, before, behind = (moving.at(x + by) for by in (0.0, -step, step))
    # Eq. (26): the secant stiffness is k / (1 - s x)
    assert here.mass == pytest.approx(40.0 / (1.0 - 2e3 * x), rel=1e-12)
    assert here.slope == pytest.approx((behind.mass - before.mass) / (2 * step), rel=1e-6)
    assert here.curvature == pytest.approx((behind.slope - before.slope) / (2 * step), rel=1e-6)


def test_sleepers_that_bend_carry_their_ballast():
    """Moments of both formulations: the ballast's inertia is spread over the sleeper in both."""
    keys = ("track.sleeper=beam", "track.ballast_mass=100", "track.supports_per_wheel=9")
    scenario = read_scenario(None, (*ONE, *keys))
    passage = run_passage(scenario, fmus=usual_build("vehicle"))
    full = solve(scenario, model="full", times=passage["time"].to_numpy())
    for name in ("sleeper_bending_moment", "sleeper_centre_bending_moment", "ballast_force"):
        ours, theirs = passage[name].to_numpy(), full[name].to_numpy()
        assert np.abs(ours - theirs).max() < 0.01 * np.abs(theirs).max(), name


@pytest.mark.parametrize(
    ("keys", "model", "sentence"),
    [
        (GROWING, "modal", r"40 kg and grows, .* use the full one \(--model full\)"),
        (
            ("track.ballast_mass=40", "track.sleeper=beam"),
            "modal",
            "40 kg and lies under sleepers that bend",
        ),
        (
            ("track.ballast_mass=40", "track.ballast_pulls=false"),
            "full",
            "a sleeper can lift off its ballast, .* let the ballast pull",
        ),
        (("track.ballast_mass=40", "variation.hanging_sleepers=5"), "full", "close the gaps"),
    ],
)
def test_what_is_not_held_is_refused(keys, model, sentence):
    with pytest.raises(InputError, match=sentence):
        built(*keys, model=model)
