"""The receptance of the track of Table 1 (Fig. 6 of the paper), direct and modal."""

from dataclasses import replace

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.receptance.dataset import compute_receptance, frequency_range
from railcosim.receptance.points import Place, parse_place, track_point
from railcosim.receptance.report import modal_deviation
from railcosim.receptance.study import ReceptanceStudy, midspan
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run
from railcosim.track_data import track_parameters
from railcosim.track_section import Track
from track_fmu.assembly import assemble
from track_fmu.ballast import PolynomialBallast
from track_fmu.modal import compute_basis
from track_fmu.reduction import reduce_track
from track_fmu.track_model import TrackModel, TrackOptions

SLEEPER = Place(sleeper=25)
WHEEL = 117_720.0


def study(**values):
    scenario = values.pop("scenario", Scenario())
    load = values.pop("load", midspan(scenario))
    return ReceptanceStudy(
        scenario=scenario, load=load, response=values.pop("response", load), **values
    )


@pytest.fixture(scope="module")
def table1():
    return study()


@pytest.fixture(scope="module")
def curves(table1):
    return compute_receptance(table1, frequency_range(10.0, 2000.0, 400))


def test_three_resonances_and_no_more(curves):
    """About 60, about 250 and above 900 Hz in the paper; here to a hertz, on any sampling."""
    assert curves["peak_frequency"].to_numpy() == pytest.approx([63.1, 257.1, 955.5], abs=0.1)
    assert curves["peak_frequency"].to_numpy() == pytest.approx([64.0, 258.0, 955.0], abs=1.0)


def test_on_a_long_track_the_third_resonance_is_the_pinned_pinned_one():
    """Where no waves come back from clamped ends; 943.1 Hz for an undamped Timoshenko beam pinned
    at the sleepers, which 8 elements in a bay raise by 2 Hz.
    """
    long = study(scenario=Scenario(track=Track(bays=100)))
    (peak,) = compute_receptance(long, frequency_range(800.0, 1100.0, 200), ("direct",))[
        "peak_frequency"
    ].to_numpy()
    assert peak == pytest.approx(943.1, abs=2.0)


def test_peaks_are_found_between_the_samples(table1, curves):
    coarse = compute_receptance(table1, frequency_range(20.0, 400.0, 40), ("direct",))
    found = coarse["peak_frequency"].to_numpy()
    assert found == pytest.approx(curves["peak_frequency"].to_numpy()[:2], abs=0.02)


def test_static_flexibility_at_midspan(curves):
    """Also of the modes, which the residual flexibility completes."""
    assert curves["static_flexibility"].to_numpy() == pytest.approx(16.84e-9, abs=0.005e-9)


def test_the_track_resists_at_every_frequency(curves):
    """A passive track takes power up: the displacement lags the force by 0 to 180 degrees."""
    phase = curves["phase"].to_numpy()
    assert ((phase < 0.0) & (phase > -180.0)).all()


@pytest.mark.parametrize("sleeper", ["rigid", "beam"])
@pytest.mark.parametrize("preload", [0.0, WHEEL])
def test_modes_with_residual_agree_with_the_whole_track(preload, sleeper):
    """What is missing is what the truncated modes do beyond their static part R.

    Each would have its part of R times ``1 / (1 - x^2 + 2 i zeta x)``, ``x = f / f_n``; with f_M of
    the last mode kept, that is at most ``R (x^2 + 2 zeta x) / (1 - x^2)``, ``x = f / f_M``. Modes
    up there have up to 2 % of critical damping.
    """
    case = study(scenario=Scenario(track=Track(sleeper=sleeper)), preload=preload)
    frequencies = np.array([5.0, 64.0, 258.0, 500.0, 955.0, 1200.0, 1500.0, 2000.0])
    point = track_point(track_parameters(Scenario().track), case.load)
    flexibility = case._reduced.flexibility[np.ix_(point.rows, point.rows)]
    residual = point.shape @ flexibility @ point.shape
    last = case._reduced.eigenvalues[-15:]
    zeta = 0.02
    assert (-last.real / np.abs(last)).max() < zeta
    x = 2 * np.pi * frequencies / np.abs(last[-1])
    direct = case.receptance(frequencies, "direct")
    missing = np.abs(case.receptance(frequencies, "modal") - direct)
    assert (missing < residual * (x**2 + 2 * zeta * x) / (1 - x**2)).all()


@pytest.mark.parametrize("preload", [0.0, WHEEL])
def test_all_modes_are_the_whole_track(preload):
    track = Track(bays=8, elements_per_bay=4, mode_pairs=69)
    scenario = Scenario(track=track, flat=Flat(position=2.6), run=Run(approach=0.5, departure=0.5))
    short = study(scenario=scenario, load=Place(position=2.2), response=Place(sleeper=5))
    short = replace(short, preload=preload)
    frequencies = frequency_range(10.0, 5000.0, 40)
    direct, modal = (short.receptance(frequencies, name) for name in ("direct", "modal"))
    assert np.abs(modal / direct - 1.0).max() < 1e-7


def test_modes_without_residual_are_too_stiff():
    """By 0.2 to 5 % in the statics at midspan, and the dataset says so."""
    short = study(scenario=Scenario(track=Track(residual_flexibility=False)))
    result = compute_receptance(short, frequency_range(10.0, 20.0, 3))
    direct, modal = result["static_flexibility"].to_numpy()
    assert 0.002 < 1.0 - modal / direct < 0.05
    assert 0.002 < modal_deviation(result)["largest"] < 0.05


@pytest.mark.parametrize("method", ["direct", "modal"])
@pytest.mark.parametrize("preload", [0.0, WHEEL])
def test_force_and_response_may_be_exchanged(method, preload):
    """Maxwell and Betti; the preload stays where it was."""
    there = study(load=SLEEPER, response=Place(position=16.25), preload=preload)
    back = study(load=Place(position=16.25), response=SLEEPER, preload=preload)
    frequencies = np.array([0.0, 64.0, 258.0, 955.0])
    forth = there.receptance(frequencies, method)
    assert back.receptance(frequencies, method) == pytest.approx(forth, rel=1e-9)


def static_sinking(force, position):
    """Rail displacement under a standing wheel in nonlinear equilibrium [m]."""
    parameters = track_parameters(Scenario().track)
    matrices = assemble(parameters)
    reduced = reduce_track(parameters, matrices, compute_basis(matrices, mode_pairs=60))
    model = TrackModel(reduced, TrackOptions(wheels=1), ballast=PolynomialBallast())
    model.start(np.array([position]), np.array([force]))
    return model.rail_displacement[0]


def test_the_static_receptance_under_a_preload_is_the_tangent_of_the_sinking():
    step, position = 50.0, 16.575
    sinking = [static_sinking(WHEEL + d, position) for d in (-step, step)]
    tangent = (sinking[1] - sinking[0]) / (2 * step)
    value = study(preload=WHEEL).receptance(np.zeros(1))[0]
    assert value.real == pytest.approx(tangent, rel=1e-6)
    assert value.imag == 0.0


def test_a_small_preload_is_an_unloaded_track_and_a_wheel_halves_the_flexibility(table1):
    frequencies = np.array([0.0, 64.0])
    unloaded = table1.receptance(frequencies)
    assert study(preload=1e-3).receptance(frequencies) == pytest.approx(unloaded, rel=1e-6)
    assert abs(study(preload=WHEEL).receptance(frequencies)[0]) < 0.5 * abs(unloaded[0])


def test_places_have_names():
    assert parse_place("16.25", "--position") == Place(position=16.25)
    assert parse_place("sleeper:25", "--position") == SLEEPER
    assert [str(Place(position=16.25)), str(SLEEPER)] == ["rail at 16.25 m", "sleeper 25"]


@pytest.mark.parametrize("text", ["here", "nan", "inf", "sleeper:x", "sleeper:2.5", ""])
def test_other_places_are_refused(text):
    with pytest.raises(InputError, match=r"--response .*is no place"):
        parse_place(text, "--response")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"load": Place(position=33.0)}, "33 m is not between"),
        ({"response": Place(position=0.0)}, "0 m is not between"),
        ({"response": Place(sleeper=50)}, "sleepers 1 to 49"),
        ({"load": Place(sleeper=0)}, "sleepers 1 to 49"),
        ({"preload": -1.0}, "from 0 to 1e.07 N"),
        ({"preload": 1e300}, "from 0 to 1e.07 N"),
        ({"preload": float("nan")}, "from 0 to 1e.07 N"),
        (
            {"preload": 1e4, "scenario": Scenario(track=Track(ballast="linear"))},
            "changes nothing on a linear track",
        ),
    ],
)
def test_wrong_studies_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        study(**values)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((0.0, 100.0, 10), "no range"),
        ((100.0, 100.0, 10), "no range"),
        ((10.0, float("inf"), 10), "no range"),
        ((10.0, 100.0, 2), "choose 3 to"),
        ((10.0, 100.0, 10**6), "choose 3 to"),
    ],
)
def test_wrong_ranges_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        frequency_range(*values)


def test_a_bending_sleeper_at_its_rail_seat_by_modes_and_by_matrices():
    """Its place among the modal coordinates is that of the rail less the pad's deformation."""
    case = study(scenario=Scenario(track=Track(sleeper="beam")), load=SLEEPER)
    frequencies = np.array([0.0, 20.0, 63.0, 130.0, 257.0, 650.0])
    direct, modal = (case.receptance(frequencies, method) for method in ("direct", "modal"))
    assert modal[0] == pytest.approx(direct[0], rel=1e-9)
    # at 350 pairs, which reach 2.8 kHz
    assert np.abs(modal - direct).max() < 1e-3 * np.abs(direct).min()


def test_peaks_do_not_depend_on_where_the_range_ends(table1, curves):
    narrow = compute_receptance(table1, frequency_range(50.0, 270.0, 50), ("direct",))
    found = narrow["peak_frequency"].to_numpy()
    assert found == pytest.approx(curves["peak_frequency"].to_numpy()[:2], abs=0.02)
