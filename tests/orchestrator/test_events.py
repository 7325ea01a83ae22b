"""Switches of indicators given as functions of time."""

from math import exp, log, pi, sin

import numpy as np
import pytest
from fake_participants import Answering, Fake

from orchestrator import (
    Cause,
    Connection,
    ErrorControl,
    Master,
    MasterSettings,
    Recorder,
    SettingsError,
    System,
    WiringError,
    ZenoError,
)
from orchestrator.bracket import Bracket, root_of_interpolation
from orchestrator.events import Switches


class Signals(Fake):
    """Outputs that are functions of time."""

    def __init__(self, **functions):
        self.outputs = tuple(functions)
        self.functions = list(functions.values())
        super().__init__("signals")

    def initial_outputs(self, _values):
        return [function(self.time) for function in self.functions]

    def advance(self, over):
        return [function(over.time + over.step_size) for function in self.functions]


def locate(stop, step, settings=None, **functions):
    signals = Signals(**functions)
    recorder = Recorder()
    master = Master(
        System([signals], []),
        MasterSettings(tolerance=None, fixed_step=step, **(settings or {})),
        events=[f"signals.{name}" for name in functions],
        observers=[recorder],
    )
    return master.run(0.0, stop), recorder


def times(outcome):
    return [item.time for item in outcome.switches]


def test_the_earliest_of_several_switches_comes_first():
    outcome, _ = locate(1.0, 1.0, late=lambda t: 0.31 - t, early=lambda t: t - 0.3)
    assert [item.indicator for item in outcome.switches] == ["signals.early", "signals.late"]
    assert [item.positive for item in outcome.switches] == [True, False]
    assert times(outcome) == pytest.approx([0.3, 0.31], abs=1e-10)


def test_switches_at_the_same_time_are_one_landing():
    outcome, recorder = locate(1.0, 1.0, first=lambda t: 0.5 - t, second=lambda t: 2.0 * t - 1.0)
    assert times(outcome) == [recorder.time[1]] * 2
    assert recorder.time == pytest.approx([0.0, 0.5, 1.0], abs=1e-10)


@pytest.mark.parametrize("step", [0.5, 0.2, 0.05, 0.01])
def test_smooth_indicators_need_few_attempts(step):
    # From four steps a period to two hundred.
    outcome, _ = locate(10.0, step, wave=lambda t: sin(3.0 * t + 0.2))
    exact = (np.arange(1, 10) * pi - 0.2) / 3.0
    assert times(outcome) == pytest.approx(exact, abs=1e-9)
    assert outcome.statistics.rejected["event"] / exact.size + 1.0 <= 5.0


@pytest.mark.parametrize("power", [1, 3, 9])
def test_flat_and_steep_roots_are_found(power):
    def indicator(t):
        return (t - 0.37) ** power if power > 1 else 1e8 * (t - 0.37)

    outcome, recorder = locate(1.0, 1.0, flat=indicator)
    assert outcome.statistics.switches == 1
    landed = abs(recorder["signals.flat"][1])
    # Either the indicator or the bracket in time is small enough.
    assert landed <= 1e-10 or abs(times(outcome)[0] - 0.37) <= 1e-9


def test_a_jump_is_bracketed_in_time_from_beyond():
    outcome, recorder = locate(1.0, 1.0, jump=lambda t: 1.0 if t < 0.7310 else -1.0)
    assert 0.0 <= times(outcome)[0] - 0.7310 <= 1e-9
    assert recorder["signals.jump"].tolist() == [1.0, -1.0, -1.0]
    # Halving the step of one second down to a nanosecond takes 30 attempts; the safeguard may
    # waste two interpolations for every halving.
    assert outcome.statistics.rejected["event"] < 100


@pytest.mark.parametrize("begin", np.linspace(0.388, 0.392, 9))
def test_a_return_within_the_next_step_is_found(begin):
    # The step from 0.2 to 0.4 ends within the dip. After landing on its beginning, the step of a
    # tenth of that ends behind the dip, on the side where the indicator was before.
    dip = Signals(dip=lambda t: (t - begin) * (t - 0.405))
    outcome = Master(
        System([dip], []),
        MasterSettings(tolerance=1.0),
        controller=ErrorControl(initial_step=0.2, min_step=1e-6, max_step=0.2),
        events=["signals.dip"],
    ).run(0.0, 1.0)
    assert times(outcome) == pytest.approx([begin, 0.405], abs=1e-8)
    assert [item.positive for item in outcome.switches] == [False, True]


def test_a_step_too_inaccurate_to_land_with_gives_up_the_search():
    # The exchanged value bends at 0.475: landing on the switch at 0.495 in one step is 20 times too
    # inaccurate, so that smaller steps are taken first, and the switch is found from closer.
    signals = Signals(switch=lambda t: 0.495 - t, bend=lambda t: 50.0 * max(t - 0.475, 0.0) ** 2)
    sink = Answering("sink", lambda _t, _h: None)
    master = Master(
        System([signals, sink], [Connection(source="signals.bend", target="sink.u")]),
        MasterSettings(tolerance=1e-3),
        controller=ErrorControl(initial_step=0.05, min_step=1e-6, max_step=0.05),
        events=["signals.switch"],
    )
    outcome = master.run(0.0, 0.6)
    assert times(outcome) == pytest.approx([0.495], abs=1e-9)
    log_ = outcome.step_log
    rejected = log_[np.isclose(log_["time"], 0.475) & (log_["cause"] > 0)]
    assert Cause.ERROR in rejected["cause"]
    accepted = log_[log_["cause"] == 0]
    assert np.sum((accepted["time"] > 0.474) & (accepted["time"] < 0.495 - 1e-9)) > 2


def test_the_switch_just_landed_on_is_not_the_next_one():
    switches = Switches(["a"], tolerance=1e-10, time_tolerance=1e-9, limit=9, window=1e-9)
    switches.start([1.0])
    switches.accept(1.0, 1.0, [-5e-11], switches.examine(1.0, [-5e-11]))
    # Back on the old side after a step of 1: where in between is anyone's guess at first, then
    # the parabola through the landing and these two points tells.
    refine = switches.examine(1.0, [0.5])
    assert refine == (0.5, True)
    switches.narrow()
    assert switches.examine(0.5, [-0.25]) == (pytest.approx(0.75), False)


def test_a_switch_cuts_the_history_of_all_indicators():
    switches = Switches(["a", "b"], tolerance=1e-10, time_tolerance=1e-9, limit=9, window=1e-9)
    switches.start([4.0, 1.0])
    switches.accept(1.0, 1.0, [3.0, 0.0], switches.examine(1.0, [3.0, 0.0]))
    assert [item.indicator for item in switches.found] == ["b"]
    # The straight line from 3 to -1: with the value of 4 before the switch it would be bent.
    assert switches.examine(1.0, [-1.0, -1.0]).next_step == pytest.approx(0.75)


def test_landing_on_a_switch_does_not_find_it_again():
    outcome, recorder = locate(1.0, 0.1, line=lambda t: 0.25 - t)
    assert outcome.statistics.switches == 1
    assert recorder.time == pytest.approx(
        [0.0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0], abs=1e-9
    )


def test_an_indicator_that_starts_at_zero_takes_its_side_on_leaving():
    outcome, _ = locate(1.0, 0.1, leaving=lambda t: -t, other=lambda t: t * (t - 0.55))
    assert [item.indicator for item in outcome.switches] == ["signals.other"]
    assert times(outcome) == pytest.approx([0.55], abs=1e-9)


def test_a_step_that_happens_to_end_on_a_switch_has_landed():
    outcome, _ = locate(1.0, 0.25, line=lambda t: 0.5 - t)
    assert times(outcome) == [0.5]
    assert outcome.statistics.rejected["event"] == 0


def test_touching_without_crossing_is_no_switch():
    outcome, _ = locate(1.0, 0.1, touching=lambda t: (t - 0.55) ** 2 + 1e-6)
    assert outcome.statistics.switches == 0


def accumulating(t, rate=20.0):
    """Changes sign at 1 - exp(-n pi / rate): without end before t = 1."""
    rest = 1.0 - t
    return rest * sin(rate * log(rest)) if rest > 0.0 else 0.0


def test_switches_without_end_are_an_error_that_names_the_indicator():
    master = Master(
        System([Signals(bounce=accumulating)], []),
        MasterSettings(
            tolerance=1.0, max_switches=20, event_time_tolerance=1e-12, accumulation_share=1e-9
        ),
        controller=ErrorControl(initial_step=1e-3, min_step=1e-12, max_step=1e-3),
        events=["signals.bounce"],
    )
    message = r"signals\.bounce and others switched 21 times within 1e-06 s up to t = 0\.99999"
    with pytest.raises(ZenoError, match=message):
        master.run(0.0, 1.0)


def test_switches_are_exact_up_to_where_they_accumulate():
    outcome, _ = locate(0.99, 0.001, bounce=accumulating)
    exact = [1.0 - exp(-n * pi / 20.0) for n in range(1, 30)]
    exact = [t for t in exact if t < 0.99]
    assert times(outcome) == pytest.approx(exact, abs=1e-9)


def test_after_a_switch_the_step_is_small_and_grows_again():
    signals = Signals(line=lambda t: 0.333 - t)
    controller = ErrorControl(initial_step=0.01, min_step=1e-6, max_step=0.01)
    outcome = Master(
        System([signals], []),
        MasterSettings(tolerance=1.0),
        controller=controller,
        events=["signals.line"],
    ).run(0.0, 1.0)
    log_ = outcome.step_log[outcome.step_log["cause"] == 0]
    after = np.flatnonzero(log_["time"] >= 0.333 - 1e-9)[0]
    assert log_["step_size"][after] == pytest.approx(1e-3, rel=0.2)
    assert log_["step_size"][after] <= 1e-3
    assert log_["step_size"][after + 12] == 0.01


def test_the_outputs_seen_as_indicators_must_exist_and_be_real():
    with pytest.raises(WiringError, match=r"signals has no variable 'b'.*known are 'a'"):
        Master(System([Signals(a=abs)], []), MasterSettings(tolerance=1.0), events=["signals.b"])


def test_events_need_positive_tolerances():
    with pytest.raises(SettingsError, match=r"event_tolerance = 0 must be positive"):
        MasterSettings(tolerance=1.0, event_tolerance=0)


def test_the_interpolation_is_exact_for_cubics():
    points = [(t, (0.3 - t) * (t * t + 1.0)) for t in (0.0, 1.0, -0.5, -1.0)]
    assert root_of_interpolation(points, 0.0, 1.0) == pytest.approx(0.3, abs=1e-14)
    assert root_of_interpolation([(0.0, 1.0), (1.0, 2.0)], 0.0, 1.0) is None


def test_a_bracket_keeps_its_ends_apart():
    bracket = Bracket((0.0, (1.0,)), (1.0, (-1e-4,)), ())
    size = bracket.next_size(tolerance=1e-30, at_rest=(False,), margin=1e-3)
    assert size == pytest.approx(1.0 - 1e-3)
