"""Laws of ballast and pads in the monolith: closed forms, derivatives, and the FMUs' own."""

from pathlib import Path

import numpy as np
import pytest

from fmu_src.python.track_laws import make_laws
from railcosim.monolithic.support_laws import support_laws
from railcosim.scenario_file import read_scenario
from railcosim.support_values import support_values
from railcosim.track_data import track_parameters

EXAMPLES = Path(__file__).parents[2] / "examples"
SMALL = ("track.bays=10", "flat.position=3.6", "run.approach=0.2", "run.departure=0.2")
DIFFERENT = (
    "variation.pad_stiffness_deviation=0.3",
    "variation.ballast_stiffness_deviation=0.4",
    "variation.hanging_sleepers=3-4",
    "variation.hanging_gap=0.2e-3",
    "variation.missing_fastenings=6",
    "variation.missing_pads=8",
)
TRACKS = {
    "the paper's": (),
    "linear that differs": ("track.ballast=linear", *DIFFERENT),
    "polynomial, tangent damping": ("track.ballast_tangent_damping=true", *DIFFERENT),
    "hyperbolic": ("track.ballast=hyperbolic", *DIFFERENT),
    "hyperbolic, does not pull": ("track.ballast=hyperbolic", "track.ballast_pulls=false"),
    "masses, does not pull": (
        "track.ballast_pulls=false",
        "variation.sleeper_mass_deviation=0.4",
        *DIFFERENT,
    ),
    "table": (f"track.ballast={EXAMPLES / 'ballast.csv'}", *DIFFERENT),
    "table of a pad": (f"track.pad={EXAMPLES / 'ballast.csv'}", *DIFFERENT),
}
RELAXING = (f"track.pad={EXAMPLES / 'pad.csv'}", *DIFFERENT)
SUPPORTS = 9


def scenario(*overrides):
    return read_scenario(None, (*SMALL, *overrides))


def laws_of(case, *, all_in_matrices=False):
    return support_laws(case, case.track, all_in_matrices=all_in_matrices)


def motions(count, seed=2):
    """Deformations from -0.3 to 0.7 mm and rates within 50 mm/s."""
    random = np.random.default_rng(seed)
    return random.uniform(-3e-4, 7e-4, count), random.uniform(-0.05, 0.05, count)


def increments(case, deformation, rate):
    """What the laws of the track FMU give for all supports, ballast first."""
    track = case.track
    values = {name: getattr(track, name) for name in track.__slots__}
    both = make_laws(track_parameters(track), values | support_values(case))
    everywhere = np.arange(SUPPORTS)
    parts = [slice(0, SUPPORTS), slice(SUPPORTS, 2 * SUPPORTS)]
    return np.concatenate(
        [
            np.zeros(SUPPORTS)
            if law is None
            else law.force(deformation[part], rate[part], everywhere)
            for law, part in zip(both, parts, strict=True)
        ]
    )


@pytest.mark.parametrize("keys", TRACKS.values(), ids=TRACKS)
def test_forces_are_those_of_the_fmus(keys):
    """Written twice from the same equations; rounding of forces up to 1e5 N is left."""
    case = scenario(*keys)
    laws = laws_of(case)
    for seed in range(20):
        deformation, rate = motions(2 * SUPPORTS, seed)
        ports = 2 * SUPPORTS if laws.pads_have_ports else SUPPORTS
        ours = laws.tangent(deformation[:ports], rate[:ports], np.zeros(0)).force
        theirs = increments(case, deformation, rate)
        assert ours == pytest.approx(theirs[:ports], abs=1e-6)
        assert not theirs[ports:].any()


@pytest.mark.parametrize("keys", [*TRACKS.values(), RELAXING], ids=[*TRACKS, "relaxing pads"])
@pytest.mark.parametrize("all_in_matrices", [False, True])
def test_tangents_are_derivatives(keys, all_in_matrices):
    laws = laws_of(scenario(*keys), all_in_matrices=all_in_matrices)
    ports = 2 * SUPPORTS if laws.pads_have_ports else SUPPORTS
    deformation, rate = motions(ports)
    memory = laws.relaxed(deformation) + 100.0
    tangent = laws.tangent(deformation, rate, memory)
    for change, expected in (
        ((1e-9, 0.0, 0.0), tangent.stiffness),
        ((0.0, 1e-6, 0.0), tangent.damping),
        ((0.0, 0.0, 1e-2), laws.by_memory(deformation, memory)),
    ):
        ends = [
            laws.tangent(
                deformation + sign * change[0], rate + sign * change[1], memory + sign * change[2]
            ).force
            for sign in (-1.0, 1.0)
        ]
        slope = (ends[1] - ends[0]) / (2.0 * sum(change))
        assert slope == pytest.approx(expected, rel=1e-5, abs=1e-5 * 80e6 * (change[0] > 0.0) + 0.1)


def test_what_is_linear_goes_into_the_matrices():
    """Factors on linear pads and ballast leave nothing for the ports, but for what can open."""
    laws = laws_of(scenario("track.ballast=linear", *DIFFERENT), all_in_matrices=True)
    deformation, rate = motions(2 * SUPPORTS)
    borne = laws.tangent(deformation, rate, np.zeros(0)).force
    opening = np.isin(np.arange(2 * SUPPORTS), (2, 3, SUPPORTS + 5))
    assert np.abs(borne[~opening]).max() < 1e-9
    assert laws.base.ballast_stiffness[2] == laws.base.pad_stiffness[5] == 0.0
    assert laws.base.pad_stiffness[7] == laws.base.pad_damping[7] == 0.0


def test_a_relaxing_pad_bears_the_preload_s_integral():
    """At rest ``dP/dx = k0`` and at once ``k0 + k1``, of straight lines between the rows."""
    case = scenario(f"track.pad={EXAMPLES / 'pad.csv'}")
    pads = laws_of(case).pads
    # between 20 and 30 kN k0 = 20e6 + 600 (P - 20e3), so that k0 = 20e6 exp(600 x)
    x = np.full(SUPPORTS, 3e-4)
    still = np.zeros(SUPPORTS)
    expected = 20e6 * np.expm1(600.0 * x) / 600.0
    at_rest = pads.tangent(x, still, pads.relaxed(x))
    assert at_rest.force == pytest.approx(expected, rel=1e-8)
    # the branch is three times as stiff in this table, everywhere
    at_once = pads.tangent(x, still, pads.relaxed(np.zeros(SUPPORTS)))
    assert at_once.force == pytest.approx(4.0 * expected, rel=1e-8)
    stiffness, damping = pads.branches(x)
    assert stiffness == pytest.approx(60e6 * np.exp(0.18), rel=1e-6)
    assert damping == pytest.approx(600e3 * np.exp(0.18), rel=1e-6)


def test_memories_relax_with_the_branch_s_time():
    """``m' = s k1 / c1``, 100 /s in this table, and its derivatives."""
    laws = laws_of(scenario(*RELAXING))
    deformation, _ = motions(2 * SUPPORTS)
    memory = laws.relaxed(deformation) - 1000.0
    change = laws.relaxation(deformation, memory)
    there = laws.supports.pad_stiffness > 0.0
    ratio = laws.supports.pad_stiffness[there] / laws.supports.pad_damping[there]
    assert change.rate[there] == pytest.approx(1000.0 * 100.0 * ratio, rel=1e-6)
    assert not change.rate[~there].any()
    assert laws.relaxation(deformation, laws.relaxed(deformation)).rate == pytest.approx(0.0)
    ends = [laws.relaxation(deformation + sign * 1e-9, memory).rate for sign in (-1.0, 1.0)]
    slope = (ends[1] - ends[0]) / 2e-9
    assert slope == pytest.approx(change.by_displacement, rel=1e-5, abs=1e-5 * 6e9)
