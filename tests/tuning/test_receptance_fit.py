import itertools
from dataclasses import replace

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.receptance.measured import MeasuredReceptance
from railcosim.receptance.points import Place
from railcosim.receptance.study import midspan
from railcosim.scenario import Scenario
from railcosim.scenario_file import read_scenario
from railcosim.track_data import track_parameters
from railcosim.tuning.receptance import tune_to_receptance
from railcosim.tuning.support_receptance import SUPPORT_PARAMETERS, SupportReceptance

from .synthetic import TRUE, noisy, started

FREQUENCY = np.geomspace(20.0, 1500.0, 80)
MIDSPAN = midspan(Scenario())


def tune(scenario, measured, **values):
    places = {"load": MIDSPAN, "response": MIDSPAN, **values}
    return tune_to_receptance(scenario, measured, **places)


def errors(tuned):
    return {item.name: item.value / TRUE[item.name] - 1.0 for item in tuned.estimates}


def test_the_parameters_are_those_of_the_track():
    assert tuple(TRUE) == SUPPORT_PARAMETERS
    assert all(getattr(Scenario().track, name) == value for name, value in TRUE.items())


@pytest.mark.parametrize(("phase", "noise"), [(True, 0.05), (False, 0.02)])
@pytest.mark.parametrize(
    "factors", [(0.5, 0.5, 0.5, 0.5), (2.0, 2.0, 2.0, 2.0), (2.0, 0.5, 0.5, 2.0)]
)
def test_table_1_is_recovered_within_3_percent(phase, noise, factors):
    """At 80 frequencies the standard errors are at most noise / 4, that is 1.3 %."""
    tuned = tune(started(*factors), noisy(FREQUENCY, noise=noise, seed=1, phase=phase))
    assert max(map(abs, errors(tuned).values())) < 0.03
    assert tuned.amplitude_deviation == pytest.approx(noise, rel=0.25)
    for item in tuned.estimates:
        assert getattr(tuned.scenario.track, item.name) == item.value


def test_intervals_cover_the_truth_as_often_as_they_claim():
    """Of 64 intervals at 95 %, 57 or more but for one in 150 sets of seeds (binomial)."""
    frequency = np.geomspace(20.0, 1500.0, 40)
    covered = [
        item.low <= TRUE[item.name] <= item.high
        for seed in range(16)
        for item in tune(Scenario(), noisy(frequency, noise=0.04, seed=seed)).estimates
    ]
    assert len(covered) == 64
    assert 57 <= sum(covered) < 64


def test_intervals_shrink_with_the_root_of_the_number_of_points():
    widths = []
    for count in (40, 160):
        frequency = np.geomspace(20.0, 1500.0, count)
        tuned = tune(Scenario(), noisy(frequency, noise=0.04, seed=3))
        widths.append([np.log(item.high / item.low) for item in tuned.estimates])
    assert np.mean(np.divide(*widths)) == pytest.approx(2.0, abs=0.4)


def test_without_noise_the_truth_is_found_from_every_corner():
    """Exactly, as far as the tolerance 1e-8 of the search goes."""
    measured = noisy(np.geomspace(20.0, 1000.0, 20), noise=0.0, seed=0)
    for factors in itertools.product((0.5, 2.0), repeat=4):
        tuned = tune(started(*factors), measured)
        assert max(map(abs, errors(tuned).values())) < 1e-5


def test_a_response_on_a_sleeper_serves_too():
    sleeper = Place(sleeper=25)
    measured = noisy(np.geomspace(20.0, 600.0, 60), noise=0.02, seed=5, response=sleeper)
    tuned = tune(started(0.7, 1.5, 1.5, 0.7), measured, response=sleeper)
    assert max(map(abs, errors(tuned).values())) < 0.03


def test_what_is_held_stays():
    tuned = tune(
        started(0.5, 1.0, 2.0, 1.0),
        noisy(FREQUENCY, noise=0.02, seed=2),
        hold=["pad_damping", "ballast_damping"],
    )
    assert [item.name for item in tuned.estimates] == ["pad_stiffness", "ballast_stiffness"]
    assert tuned.scenario.track.pad_damping == TRUE["pad_damping"]
    assert max(map(abs, errors(tuned).values())) < 0.01


@pytest.mark.parametrize("sleeper", ["rigid", "beam"])
@pytest.mark.parametrize("response", [MIDSPAN, Place(sleeper=24)])
def test_derivatives_are_those_of_the_receptance(response, sleeper):
    frequency = np.array([30.0, 64.0, 258.0, 955.0])
    parameters = track_parameters(replace(Scenario().track, sleeper=sleeper))
    model = SupportReceptance(parameters, frequency, load=MIDSPAN, response=response)
    values = np.array(list(TRUE.values()))
    derivatives = model.evaluate(values)[1]
    for k in range(4):
        step = np.zeros(4)
        step[k] = 1e-4 * values[k]
        ahead, behind = (model.evaluate(values + sign * step)[0] for sign in (1.0, -1.0))
        slope = (ahead - behind) / (2 * step[k])
        # central differences are off by the square of 1e-4, times the sharpness of a resonance
        assert derivatives[:, k] == pytest.approx(slope, rel=1e-6)


def scaled(measured, factor):
    return MeasuredReceptance(
        frequency=measured.frequency, amplitude=factor * measured.amplitude, phase=measured.phase
    )


def test_amplitudes_in_another_unit_are_refused():
    measured = scaled(noisy(FREQUENCY, noise=0.02, seed=1), 1e6)
    with pytest.raises(InputError, match=r"about 1e\+06 times .* displacement over force in m/N"):
        tune(Scenario(), measured)


def test_too_few_points_are_refused():
    measured = noisy(np.geomspace(20.0, 1000.0, 19), noise=0.02, seed=1)
    with pytest.raises(InputError, match=r"19 measured frequencies are too few .* 20 or more"):
        tune(Scenario(), measured)


def test_a_range_that_says_nothing_about_a_parameter_is_refused():
    """Far below the first resonance only the stiffness of the ballast is felt."""
    measured = noisy(np.linspace(5.0, 15.0, 40), noise=0.05, seed=1, phase=False)
    with pytest.raises(
        InputError, match=r"does not determine \w+_(damping|stiffness), .* --hold \w+$"
    ):
        tune(Scenario(), measured)


def test_noise_is_refused():
    random = np.random.default_rng(1)
    measured = MeasuredReceptance(
        frequency=FREQUENCY, amplitude=1e-8 * np.exp(1.5 * random.normal(size=FREQUENCY.size))
    )
    with pytest.raises(InputError, match=r"off by a factor of .* must be within 2"):
        tune(Scenario(), measured)


@pytest.mark.parametrize(
    ("hold", "message"),
    [
        (["sleeper_mass"], "sleeper_mass is nothing that is fitted"),
        (list(TRUE), "every parameter is held"),
    ],
)
def test_wrong_names_are_refused(hold, message):
    with pytest.raises(InputError, match=message):
        tune(Scenario(), noisy(FREQUENCY, noise=0.02, seed=1), hold=hold)


def test_a_start_of_zero_is_refused():
    with pytest.raises(InputError, match=r"track\.pad_damping is 0 but .* above 0"):
        tune(started(1.0, 0.0, 1.0, 1.0), noisy(FREQUENCY, noise=0.02, seed=1))


@pytest.mark.parametrize(
    ("override", "key"),
    [
        ("track.ballast_pulls=false", "track.ballast_pulls"),
        ("track.ballast_mass=30", "track.ballast_mass"),
        ("track.pad=pad.csv", "track.pad"),
        ("variation.missing_pads=3", r"\[variation\]"),
    ],
)
def test_supports_that_no_four_parameters_describe_are_refused(override, key):
    with pytest.raises(InputError, match=f"same at every support .* leave {key} out"):
        tune(read_scenario(None, [override]), noisy(FREQUENCY, noise=0.02, seed=1))
