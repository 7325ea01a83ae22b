"""The passage with the contacts on the track's side, against that with those of a vehicle."""

import numpy as np
import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise

STATIC_LOAD = 117_720.0
SHORT = ("run.approach=0.5", "run.departure=0.8")


def on_track(*overrides):
    return run_passage(read_scenario(None, overrides), contact="track")


def difference(passage, other, name, wheel=1):
    """Largest difference of a quantity of a wheel over the times of the first passage."""
    theirs = np.interp(passage["time"], other["time"], other[name].sel(wheel=wheel))
    return np.abs(passage[name].sel(wheel=wheel).to_numpy() - theirs).max()


@pytest.fixture(scope="module")
def short():
    return on_track(*SHORT)


def test_the_passage_is_that_of_the_default_run_without_iterating(passages, short):
    """0.06 % of the peak; most of it, and of the other differences, are the default run's own."""
    default = passages.dataset(*SHORT)
    ours, theirs = summarise(short), summarise(default)
    assert ours.peak_contact_force == pytest.approx(theirs.peak_contact_force, rel=3e-3)
    assert ours.steps.accepted == ours.steps.iterations == 1170  # 1.3 m at 100 us
    assert sum(ours.steps.rejected.values()) == 0
    assert short.attrs["warnings"] == short.attrs["unreliable"] == ""
    assert short.attrs["contact"] == "track"
    for name in (
        "max_sleeper_displacement",
        "peak_bending_moment_midspan",
        "peak_bending_moment_under_wheel",
    ):
        assert getattr(ours, name) == pytest.approx(getattr(theirs, name), rel=2e-3), name
    for wheel in (1, 2):
        assert difference(short, default, "contact_force", wheel) < 0.01 * STATIC_LOAD
        # from the unloaded rail in either, though the FMU's own count from the start
        assert difference(short, default, "wheel_displacement", wheel) < 1e-5


def test_the_start_is_static(short):
    assert (short["contact_force"].isel(time=0) == STATIC_LOAD).all()
    early = short["contact_force"].isel(time=slice(0, 100))
    # the wheels have no vertical speed yet, the rail under them has: 1.4 %, as with a vehicle that
    # has the contacts; a start that is not static jumps by 15 %
    assert float(np.abs(early - STATIC_LOAD).max()) < 0.02 * STATIC_LOAD


def test_two_runs_are_the_same_bit_for_bit(short):
    again = on_track(*SHORT)
    for name in ("contact_force", "rail_displacement", "wheel_displacement", "gap"):
        assert short[name].to_numpy().tobytes() == again[name].to_numpy().tobytes(), name


@pytest.mark.slow
def test_contact_is_lost_and_found_as_in_the_default_run(passages):
    deep = (*SHORT, "flat.depth=2e-3")
    passage, default = on_track(*deep), passages.dataset(*deep)
    ours, theirs = summarise(passage), summarise(default)
    assert ours.peak_contact_force == pytest.approx(theirs.peak_contact_force, rel=3e-3)
    assert ours.min_contact_force == theirs.min_contact_force == 0.0
    assert ours.loss_of_contact_time == pytest.approx(theirs.loss_of_contact_time, abs=1e-4)


@pytest.mark.slow
def test_a_fresh_flat_strikes_hard_and_is_not_mistaken_for_divergence(passages):
    """The force rises by four static loads and rings for long."""
    ours = summarise(on_track("flat.shape=chord"))
    theirs = passages.summary("flat.shape=chord")
    assert ours.peak_contact_force == pytest.approx(theirs.peak_contact_force, rel=5e-3)
    assert ours.loss_of_contact_time == pytest.approx(theirs.loss_of_contact_time, abs=3e-4)


@pytest.mark.slow
def test_the_whole_passage_is_that_of_the_default_run(passages):
    ours, theirs = summarise(on_track()), passages.summary()
    assert ours.peak_contact_force == pytest.approx(theirs.peak_contact_force, rel=3e-3)
    assert ours.max_sleeper_displacement == pytest.approx(theirs.max_sleeper_displacement, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("overrides", "allowed"),
    [
        ((), 3e-4),
        (("master.algorithm=gauss_seidel", "master.step=1e-4"), 3e-4),
        (("master.algorithm=newton",), 1e-3),
        (("master.step=2e-4",), 2e-3),
    ],
    ids=["default", "vehicle first", "iterated with error control", "200 us"],
)
def test_all_ways_to_step_the_pair_lead_to_one_force(passages, overrides, allowed):
    """That of Newton coupling with the contacts on the other side, at 25 us."""
    exact = passages.summary(*SHORT, "master.step=2.5e-5").peak_contact_force
    peak = summarise(on_track(*SHORT, *overrides)).peak_contact_force
    assert peak == pytest.approx(exact, rel=allowed)
