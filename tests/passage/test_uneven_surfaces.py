"""Passages over uneven rails on uneven wheels, against other formulations and geometry."""

import numpy as np
import pytest

from railcosim.irregularity.windows import onset
from railcosim.passage import run_passage
from railcosim.rail_sections import Corrugation, Joint
from railcosim.scenario import Scenario
from railcosim.scenario_file import read_scenario
from railcosim.sections import Flat, Run, Surface
from railcosim.wheel_sections import Polygon

from .full_model import FullModel, haversine
from .reference_case import SPEED, STATIC_LOAD

pytestmark = pytest.mark.xdist_group("passage")

FLAT = 16.6
START = 16.2
RAMP = 0.2
WAVE = Corrugation(wavelength=0.12, depth=8e-5)
JOINT = Joint(position=16.7, length=0.4, depth=4e-4)
POLYGONS = (
    Polygon(order=20, amplitude=2e-5),
    Polygon(order=20, amplitude=3e-5, phase_deg=90.0, wheel=2),
)


def rail(x):
    """The irregularities of `WAVE` and `JOINT` by themselves, counted from the start."""
    wave = [4e-5 * np.sin(2 * np.pi * at / 0.12) for at in (x, START)]
    a = min(abs(x - 16.7) / 0.2, 1.0)
    return (wave[0] + 4e-4 * (1 - a) ** 2 - wave[1]) * float(onset(np.array(x - START), RAMP))


def first(x):
    return rail(x) + 2e-5 * np.cos(20 * (x - FLAT) / 0.45)


def second(x):
    return rail(x) - 3e-5 * np.sin(20 * (x - FLAT) / 0.45)


@pytest.fixture(scope="module")
def scenario():
    return Scenario(
        flat=Flat(shape="none"),
        irregularity=(WAVE, JOINT),
        wheel_defect=POLYGONS,
        surface=Surface(ramp=RAMP),
        run=Run(approach=FLAT - START, departure=0.3),
    )


@pytest.mark.parametrize("contact", ["vehicle", "track"])
def test_contact_forces_are_those_of_the_full_model(scenario, contact):
    """The whole track without modes, by Newmark's rule, over closed forms: 1 % of the load.

    In the tables crests are flatter by 0.3 % of an amplitude that is a third of the compression.
    """
    expected = FullModel().run(
        speed=SPEED, drop=first, second_drop=second, start=START, stop=16.9, step=2.5e-5
    )
    passage = run_passage(scenario, fmus="native", contact=contact)
    forces = {1: expected.force, 2: expected.second_force}
    for wheel, force in forces.items():
        of_wheel = passage.sel(wheel=wheel)
        # they start with the velocity of their treads in both, so the whole way is compared
        position = expected.position - 1.8 * (wheel - 1)
        ours = np.interp(position, of_wheel["wheel_position"], of_wheel["contact_force"])
        assert np.abs(ours - force).max() < 0.01 * STATIC_LOAD
        assert np.ptp(force) > 0.3 * STATIC_LOAD


def test_the_start_is_static_equilibrium(scenario):
    start = run_passage(scenario, fmus="native").isel(time=0)
    # to a rounding of the compression, 1e-4 m, and what the coupling leaves
    assert start["contact_force"].to_numpy() == pytest.approx(STATIC_LOAD, rel=1e-9)


@pytest.mark.parametrize(("contact", "agreement"), [("vehicle", 1e-9), ("track", 2e-6)])
def test_the_gap_is_that_of_the_geometry_on_both_sides_of_a_loss(contact, agreement):
    """Level of the surface less that of the wheel, both in the result, around a loss of contact.

    They agree to what the coupling leaves; contacts on the track's side see the wheel where they
    continue it to, which it differs from by 1 um on impact.
    """
    case = read_scenario(None, ("flat.depth=2e-3", "run.approach=0.3", "run.departure=0.4"))
    wheel = run_passage(case, fmus="native", contact=contact).sel(wheel=1)
    gap = wheel["gap"].to_numpy()
    tread = [haversine(x - FLAT, depth=2e-3) for x in wheel["wheel_position"].to_numpy()]
    surface = wheel["rail_displacement"].to_numpy() + np.array(tread)
    geometry = surface - wheel["wheel_displacement"].to_numpy()
    assert gap == pytest.approx(geometry, abs=agreement)

    apart = np.flatnonzero(gap > agreement)
    apart = apart[: 1 + np.argmax(np.append(np.diff(apart), 2) > 1)]  # the first loss
    assert gap[apart].max() > 1e-5
    before, after = apart[0] - 1, apart[-1] + 1
    assert gap[before - 3] < -1e-6
    assert gap[after + 3] < -1e-6
    force = wheel["contact_force"].to_numpy()
    assert not force[apart].any()
    assert (force[[before - 3, after + 3]] > 0.0).all()
    assert force[apart] == pytest.approx(9.17e10 * np.maximum(-gap[apart], 0.0) ** 1.5)

    flying = apart[1:-1]
    t = wheel["time"].to_numpy()[flying]
    z = wheel["wheel_displacement"].to_numpy()[flying]
    # free of the rail a wheel is accelerated by its static load alone
    parabola = np.polynomial.Polynomial.fit(t - t[0], z, 2).convert()
    assert 2.0 * parabola.coef[2] == pytest.approx(STATIC_LOAD / 592.5, rel=1e-3)
