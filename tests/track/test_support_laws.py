"""Whole laws of ballast and pads, support by support, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from track_fmu.ballast import PolynomialBallast, secant_displacement
from track_fmu.characteristics import (
    HyperbolicCharacteristic,
    LinearCharacteristic,
    PolynomialCharacteristic,
    TableCharacteristic,
)
from track_fmu.pad_memory import PadMemory
from track_fmu.pads import TotalPad
from track_fmu.preloaded_pad import PreloadedPad
from track_fmu.support_factors import SupportFactors
from track_fmu.total_ballast import TotalBallast
from track_fmu.viscoelastic_pads import ViscoelasticPads

K, C = 30e6, 31e3
SLEEPER, RAIL = 1226.0, 383.0  # N
WEIGHT = SLEEPER + RAIL
ONE = np.zeros(1, dtype=np.intp)
PAPER = {"alpha": 0.37e12, "beta": -2.47e15, "delta": 5.75e18}
TABLE = np.array([-1e-4, 0.0, 1e-4, 3e-4, 6e-4]), np.array([-2e3, 0.0, 4e3, 2e4, 9e4])
CHARACTERISTICS = {
    "linear": LinearCharacteristic(),
    "polynomial": PolynomialCharacteristic(**PAPER),
    "hyperbolic": HyperbolicCharacteristic(stiffness=K, slope=2e3),
    "table": TableCharacteristic(*TABLE, stiffness=K),
}
PRELOAD = np.array([20e3, 30e3, 40e3, 60e3, 80e3])
K0 = np.array([20e6, 26e6, 33e6, 50e6, 70e6])


def ballast(characteristic, *, supports=1, own=(), **options):
    factors = replace(SupportFactors.nominal(supports), **dict(own))
    return TotalBallast(
        characteristic=characteristic,
        linear_stiffness=K,
        linear_damping=C,
        factors=factors,
        sleeper_weight=SLEEPER,
        rail_weight=RAIL,
        **options,
    )


def whole(law, x, v):
    """Total force of the ballast, the linear part included."""
    x, v = np.atleast_1d(x), np.broadcast_to(v, np.shape(np.atleast_1d(x)))
    support = np.zeros(len(x), dtype=np.intp)
    return law.force(x, v, support) + K * x + C * v


@pytest.mark.parametrize("own", [{}, {"gap": np.array([1e-4])}], ids=["touching", "gap"])
@pytest.mark.parametrize("pulls", [True, False])
@pytest.mark.parametrize("tangent", [True, False], ids=["tangent damping", "secant damping"])
@pytest.mark.parametrize("kind", CHARACTERISTICS)
def test_tangents_are_the_derivatives_of_the_force_and_nothing_jumps(kind, tangent, pulls, own):
    law = ballast(CHARACTERISTICS[kind], own=own, tangent_damping=tangent, pulls=pulls)
    x = np.linspace(-2e-4, 8e-4, 1237)
    support = np.zeros(len(x), dtype=np.intp)
    for rate in (-0.05, 0.0, 0.05):
        v = np.full_like(x, rate)
        step = 1e-10
        slope = (law.force(x + step, v, support) - law.force(x - step, v, support)) / (2 * step)
        by_rate = (law.force(x, v + 1e-6, support) - law.force(x, v - 1e-6, support)) / 2e-6
        found = law.stiffness(x, v, support)
        scale = np.abs(slope).max()
        # the differences across a kink see both of its sides: that is a few of the points
        assert np.sum(np.abs(found - slope) > 1e-4 * scale) <= 4
        assert np.sum(np.abs(law.damping(x, v, support) - by_rate) > 1e-3 * C) <= 4
        # a jump would stay as it is however near two displacements are
        for point in (0.0, 1e-4):
            near = np.array([point - 1e-12, point + 1e-12])
            force = law.force(near, v[:2], support[:2])
            assert abs(force[1] - force[0]) < 1.0


def test_the_whole_polynomial_is_the_increment_of_the_paper():
    x, v = np.linspace(-3e-4, 6e-4, 91), np.linspace(-0.1, 0.1, 91)
    support = np.zeros(91, dtype=np.intp)
    expected = PolynomialBallast(tau=C / K).force(x, v, support)
    found = ballast(CHARACTERISTICS["polynomial"]).force(x, v, support)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-6)


def test_hyperbolic_ballast_is_the_measured_law_and_has_no_pole():
    law = ballast(CHARACTERISTICS["hyperbolic"])
    force = np.linspace(1e3, 120e3, 20)
    assert whole(law, secant_displacement(force), 0.0) == pytest.approx(force, rel=1e-12)
    beyond = whole(law, np.array([0.45e-3, 0.5e-3, 1e-3]), 0.0)
    stiffness = K / (1 - 0.9) ** 2  # the tangent at nine tenths of the way to the pole
    assert np.diff(beyond) == pytest.approx(stiffness * np.array([0.05e-3, 0.5e-3]), rel=1e-9)


def test_a_table_goes_through_its_points_and_rises_between_them():
    law = ballast(CHARACTERISTICS["table"])
    assert whole(law, TABLE[0], 0.0) == pytest.approx(TABLE[1], abs=1e-6)
    assert (np.diff(whole(law, np.linspace(-2e-4, 9e-4, 500), 0.0)) > 0.0).all()


@pytest.mark.parametrize("kind", CHARACTERISTICS)
def test_ballast_that_does_not_pull_loses_the_dead_weight_on_it_and_no_more(kind):
    held, law = ballast(CHARACTERISTICS[kind]), ballast(CHARACTERISTICS[kind], pulls=False)
    x, v = (grid.ravel() for grid in np.meshgrid(np.linspace(-3e-4, 6e-4, 61), (-2.0, 0.0, 0.5)))
    still = whole(held, x, 0.0)
    assert whole(law, x, 0.0) == pytest.approx(np.maximum(still, -WEIGHT), abs=1e-6)
    total = whole(law, x, v)
    assert total.min() >= -WEIGHT - 1e-6
    assert total[still <= -WEIGHT] == pytest.approx(-WEIGHT, abs=1e-6)
    # from 20 um above lifting off on it is the other ballast, as long as it presses
    pressed = (still > -WEIGHT + 2.0 * 20e-6 * K) & (total > -WEIGHT + 1e-6)
    assert total[pressed] == pytest.approx(whole(held, x, v)[pressed], abs=1e-6)


@pytest.mark.parametrize("stiffness", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("kind", CHARACTERISTICS)
def test_about_rest_ballast_that_does_not_pull_is_the_ballast_that_does(kind, stiffness):
    """Also where the weight presses it by less than the damping takes to set in, 20 um."""
    own = {"ballast_stiffness": np.array([stiffness])}
    laws = [ballast(CHARACTERISTICS[kind], own=own, pulls=pulls) for pulls in (True, False)]
    rest = np.zeros(1)
    for ask in ("force", "stiffness", "damping"):
        held, loose = (getattr(law, ask)(rest, rest, ONE) for law in laws)
        assert loose == pytest.approx(held, abs=1e-6)


def test_heavy_sleepers_lift_off_later():
    own = {"sleeper_mass": np.array([0.5, 2.0])}
    law = ballast(LinearCharacteristic(), supports=2, own=own, pulls=False)
    x = np.full(2, -1e-3)
    lifted = law.force(x, np.zeros(2), np.array([0, 1])) + K * x
    assert lifted == pytest.approx([-0.5 * SLEEPER - RAIL, -2.0 * SLEEPER - RAIL])


def test_a_hanging_sleeper_meets_its_ballast_at_the_gap():
    """Its weight hangs from the rail at rest: there is none that the ballast could lose."""
    law = ballast(CHARACTERISTICS["polynomial"], own={"gap": np.array([0.3e-3])}, pulls=False)
    touching = ballast(CHARACTERISTICS["polynomial"])
    x = np.array([-1e-3, 0.1e-3, 0.3e-3, 0.4e-3, 0.7e-3])
    expected = np.where(x > 0.3e-3, whole(touching, x - 0.3e-3, 0.0), 0.0)
    assert whole(law, x, 0.0) == pytest.approx(expected, abs=1e-6)


def test_factors_are_those_of_each_support():
    own = {"ballast_stiffness": np.array([1.0, 3.0]), "ballast_damping": np.array([1.0, 0.5])}
    law = ballast(LinearCharacteristic(), supports=2, own=own)
    support, x, v = np.array([0, 1]), np.full(2, 2e-4), np.full(2, 0.1)
    assert law.force(x, 0.0 * v, support) == pytest.approx([0.0, 2.0 * K * 2e-4])
    only_rate = law.force(x, v, support) - law.force(x, 0.0 * v, support)
    assert only_rate == pytest.approx([0.0, -0.5 * C * 0.1])


def test_a_rail_without_fastening_lifts_off_its_pad():
    pad = TotalPad(
        characteristic=LinearCharacteristic(),
        linear_stiffness=80e6,
        linear_damping=15e3,
        factors=replace(SupportFactors.nominal(1), fastened=np.zeros(1)),
    )
    for x, expected in ((-1e-4, 0.0), (1e-4, 8e3)):
        total = pad.force(np.array([x]), np.zeros(1), ONE)[0] + 80e6 * x
        assert total == pytest.approx(expected, abs=1e-6)


# viscoelastic pads


def viscoelastic(k0=K0, k1=3.0 * K0, c1=0.03 * K0):
    pad = PreloadedPad(PRELOAD, k0, k1, c1, clip_preload=20e3)
    return ViscoelasticPads(
        pad=pad, linear_stiffness=0.0, linear_damping=0.0, factors=SupportFactors.nominal(1)
    )


def test_the_load_at_rest_has_the_static_stiffness_as_its_tangent():
    pad = viscoelastic().pad
    x = np.linspace(-1e-3, 3e-3, 4001)
    static = pad.static(x)
    assert np.interp(0.0, x, static.load) == pytest.approx(0.0, abs=1e-6)
    expected = np.interp(static.load + 20e3, PRELOAD, K0)
    assert static.tangent == pytest.approx(expected, rel=1e-12)
    middle = 0.5 * (static.tangent[1:] + static.tangent[:-1])
    # but for the four steps with a corner of the stiffness in them
    assert np.diff(static.load) == pytest.approx(middle * np.diff(x), rel=1e-4)


def moved(law, path, step):
    """Forces of the branch along a path of compressions."""
    memory = PadMemory(np.zeros(1), path[:1].copy(), np.ones(1))
    loads = []
    for x in path[1:]:
        over = law.during(step, memory)
        loads.append(over.force(np.array([x]), np.zeros(1), ONE)[0])
        memory.keep(ONE, *over.remembered(np.array([x]), np.zeros(1), ONE))
    return np.array(loads)


@pytest.mark.parametrize("step", [1e-6, 1e-3, 0.1])
def test_a_ramp_and_what_remains_of_it_are_exact_for_any_step(step):
    k0, k1, c1 = 20e6, 60e6, 60e4
    same = np.ones(5)
    law = viscoelastic(k0 * same, k1 * same, c1 * same)
    rise, tau = 1e-4, c1 / k1
    loads = moved(law, np.array([0.0, rise, rise, rise]), step)
    ramp = c1 * rise / step * -np.expm1(-step / tau)
    branch = ramp * np.exp(-np.arange(3) * step / tau)
    assert loads == pytest.approx(k0 * rise + branch, rel=1e-12)


def test_a_harmonic_deformation_meets_the_standard_linear_solid():
    """Storage and loss stiffness; the error is that of straight lines, second order in the step."""
    k0, k1, c1 = 20e6, 60e6, 60e4
    same = np.ones(5)
    law = viscoelastic(k0 * same, k1 * same, c1 * same)
    for frequency in (5.0, 16.0, 100.0):
        omega = 2.0 * np.pi * frequency
        expected = k0 + k1 * 1j * omega * c1 / (k1 + 1j * omega * c1)
        errors = []
        for points in (50, 100):
            angle = 2.0 * np.pi * np.arange(30 * points + 1) / points
            loads = moved(law, 1e-5 * np.sin(angle), 1.0 / (frequency * points))
            last, phase = loads[-points:], angle[-points:]
            found = 2.0 * np.mean(last * np.exp(-1j * phase)) * 1j / 1e-5
            errors.append(abs(found - expected) / abs(expected))
        assert errors[1] < 1e-3
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)


def test_a_step_that_is_made_of_two_differs_in_third_order_for_a_pad_that_stiffens():
    law = viscoelastic()
    differences = []
    for step in (2e-3, 1e-3):
        rate = 0.05
        start = 2e-4
        one = moved(law, start + rate * step * np.array([0.0, 1.0]), step)[-1]
        two = moved(law, start + rate * step * np.array([0.0, 0.5, 1.0]), step / 2)[-1]
        differences.append(abs(one - two))
    assert differences[0] / differences[1] == pytest.approx(8.0, rel=0.25)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"k0": 0.0 * K0}, "static_stiffness is 0 N/m in row 1; it must be above 0"),
        ({"k1": -K0}, "branch_stiffness is -2e.07 N/m in row 1; it must be at least 0"),
        ({"c1": 0.0 * K0}, "branch_damping is 0"),
    ],
)
def test_pads_that_there_are_not_are_refused(values, sentence):
    with pytest.raises(ValueError, match=sentence):
        viscoelastic(**values)


def test_tables_that_do_not_rise_are_refused():
    with pytest.raises(ValueError, match="load goes from 4000 to 3000 N at point 4"):
        TableCharacteristic(TABLE[0], np.array([-2e3, 0.0, 4e3, 3e3, 9e4]), stiffness=K)
    with pytest.raises(ValueError, match="the point 0 m, 0 N must be in the table"):
        TableCharacteristic(TABLE[0] + 1e-5, TABLE[1], stiffness=K)
