import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.load_displacement import SecantLaw, equidistant_loads
from railcosim.scenario import Scenario
from railcosim.secant_data import SecantData, read_secant_data
from railcosim.track_section import Track
from railcosim.tuning.ballast import tune_to_secant_stiffness

LAW = SecantLaw()


def measured(*, noise=0.0, seed=0, largest=60e3, count=10, sleepers=4):
    """Points of Eq. (26), those of different sleepers scattered."""
    force = np.tile(equidistant_loads(largest, count), sleepers)
    scatter = noise * np.random.default_rng(seed).normal(size=force.size)
    return SecantData(force=force, stiffness=(LAW.slope * force + LAW.stiffness) * (1 + scatter))


@pytest.mark.parametrize("fit_stiffness", [False, True])
def test_the_papers_polynomial_comes_from_points_of_its_law(fit_stiffness):
    """As `test_load_displacement` has it for the law itself."""
    tuned = tune_to_secant_stiffness(Scenario(), measured(), fit_stiffness=fit_stiffness)
    track = tuned.scenario.track
    assert tuned.law.slope == pytest.approx(2e3, rel=1e-9)
    assert track.ballast_stiffness == pytest.approx(30e6, rel=1e-9)
    assert track.ballast_alpha == pytest.approx(0.37e12, rel=0.0135)
    assert track.ballast_beta == pytest.approx(-2.47e15, rel=0.006)
    assert track.ballast_delta == pytest.approx(5.75e18, rel=0.016)
    assert tuned.polynomial_deviation == pytest.approx(1.03e3, rel=0.01)
    names = [item.name for item in tuned.estimates]
    assert names[:3] == ["ballast_alpha", "ballast_beta", "ballast_delta"]
    assert names[3:] == ["ballast_stiffness"] * fit_stiffness


@pytest.mark.parametrize("fit_stiffness", [False, True])
def test_intervals_cover_the_truth_as_often_as_they_claim(fit_stiffness):
    """The slope, of 200 samples: 190 +- 3 standard deviations of 3.1."""
    exact = tune_to_secant_stiffness(Scenario(), measured())
    truth = {item.name: item.value for item in exact.estimates}
    slopes, alphas = 0, 0
    for seed in range(200):
        random = np.random.default_rng(seed)
        data = measured()
        data = SecantData(
            force=data.force, stiffness=data.stiffness + 8e6 * random.normal(size=data.force.size)
        )
        tuned = tune_to_secant_stiffness(Scenario(), data, fit_stiffness=fit_stiffness)
        slopes += tuned.slope.low <= 2e3 <= tuned.slope.high
        alpha = tuned.estimates[0]
        alphas += alpha.low <= truth["ballast_alpha"] <= alpha.high
    assert abs(slopes - 190) < 10
    assert abs(alphas - 190) < 13  # first order in the scatter only


def test_the_scatter_is_that_of_the_points():
    tuned = tune_to_secant_stiffness(Scenario(), measured(noise=0.1, seed=1))
    assert tuned.scatter == pytest.approx(0.1 * 99e6, rel=0.2)
    assert tuned.points == 40


def test_the_stiffness_is_kept_unless_it_is_to_be_fitted():
    scenario = Scenario(track=Track(ballast_stiffness=40e6, ballast="linear"))
    kept = tune_to_secant_stiffness(scenario, measured()).scenario.track
    assert (kept.ballast_stiffness, kept.ballast) == (40e6, "state_dependent")
    fitted = tune_to_secant_stiffness(scenario, measured(), fit_stiffness=True).scenario.track
    assert fitted.ballast_stiffness == pytest.approx(30e6, rel=1e-9)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (measured(count=4, sleepers=1), "4 measured points are too few"),
        (
            SecantData(force=np.linspace(50e3, 60e3, 9), stiffness=np.full(9, 1e8)),
            r"1\.2 times the smallest but must be at least 1\.5",
        ),
        (
            SecantData(force=equidistant_loads(60e3, 9), stiffness=np.full(9, 30e6)),
            "does not clearly rise with the load",
        ),
        (
            SecantData(force=equidistant_loads(60e3, 9), stiffness=np.linspace(60e6, 10e6, 9)),
            "does not clearly rise with the load",
        ),
        (measured(largest=150e3), r"would soften .* rises to 11 times .* a smaller --largest-load"),
    ],
)
def test_poor_data_are_refused(data, message):
    with pytest.raises(InputError, match=message):
        tune_to_secant_stiffness(Scenario(), data)


def test_a_smaller_largest_load_is_the_remedy():
    tuned = tune_to_secant_stiffness(Scenario(), measured(largest=150e3), largest_load=60e3)
    assert tuned.largest_load == 60e3
    assert tuned.scenario.track.ballast_alpha == pytest.approx(0.37e12, rel=0.0135)


@pytest.mark.parametrize(
    ("text", "message"),
    [("1e4,0\n", "stiffness is 0, which must be above 0"), ("-1,1e7\n", "force is -1")],
)
def test_impossible_points_are_refused(tmp_path, text, message):
    path = tmp_path / "secant.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_secant_data(path)
