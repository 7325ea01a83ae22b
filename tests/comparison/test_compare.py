import math

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from railcosim.comparison import Tolerance, Tolerances, compare
from railcosim.errors import InputError

TIMES = np.linspace(0.0, 1.0, 1001)
BUMP = 0.5 * (1.0 - np.cos(2.0 * np.pi * TIMES))  # from 0 to 1 and back: its range is 1
BUMP_RMS = math.sqrt(3.0 / 8.0)


def result(values, times=TIMES, name="force", unit="N", **attributes):
    return xr.Dataset(
        {name: ("time", np.asarray(values), {"units": unit})},
        coords={"time": ("time", np.asarray(times), {"units": "s"})},
        attrs=attributes,
    )


def one(new, old, **tolerance):
    return compare(new, old, Tolerances(default=Tolerance(**tolerance))).signals[0]


def test_a_result_agrees_with_itself_in_every_number():
    compared = compare(result(BUMP), result(BUMP), Tolerances(default=Tolerance(value=0.0)))
    assert compared.agrees
    measures = compared.signals[0].measures
    assert measures.scale == 1.0
    for name in ("nrms", "nrms_aligned", "difference", "excess", "peak_difference", "shift"):
        assert getattr(measures, name) == 0.0


def test_scaled_by_a_hundredth_differs_by_one_per_cent():
    signal = one(result(1.01 * BUMP), result(BUMP), value=0.0099)
    measures = signal.measures
    assert measures.difference == pytest.approx(0.01)
    assert measures.difference_time == pytest.approx(0.5)
    assert measures.peak_difference == pytest.approx(0.01)
    assert measures.nrms == pytest.approx(0.01 * BUMP_RMS, rel=1e-5)  # straight pieces
    assert not signal.agrees
    assert one(result(1.01 * BUMP), result(BUMP), value=0.0101).agrees


@settings(max_examples=25)
@given(
    factor=st.floats(0.5, 2.0), offset=st.floats(-2.0, 2.0), unit=st.sampled_from([1e-6, 1.0, 1e8])
)
def test_relative_numbers_do_not_depend_on_the_unit_nor_on_an_offset_of_both(factor, offset, unit):
    plain = one(result(factor * BUMP), result(BUMP)).measures
    changed = one(result(unit * (factor * BUMP + offset)), result(unit * (BUMP + offset))).measures
    assert changed.nrms == pytest.approx(plain.nrms, abs=1e-12)
    assert changed.relative_difference == pytest.approx(plain.relative_difference, abs=1e-12)


def test_a_spike_is_found_at_its_time():
    spiked = BUMP.copy()
    spiked[300] += 0.2
    measures = one(result(spiked), result(BUMP)).measures
    assert measures.difference == pytest.approx(0.2)
    assert measures.difference_time == pytest.approx(0.3)
    # two triangles 1 ms wide each: the integral of 0.2^2 (1 - s)^2 over both
    assert measures.nrms == pytest.approx(math.sqrt(0.04 * 2e-3 / 3.0))


@pytest.mark.parametrize("spiked_one", ["result", "baseline"])
def test_a_spike_narrower_than_the_tube_is_found_in_either_of_them(spiked_one):
    """In the baseline it widens the tube, which the result without it never leaves."""
    spiked = BUMP.copy()
    spiked[300] += 0.2
    pair = (spiked, BUMP) if spiked_one == "result" else (BUMP, spiked)
    signal = one(result(pair[0]), result(pair[1]), value=0.01, time=0.005)
    slope = math.pi * math.sin(0.6 * math.pi)  # of the bump, which rises 5 ms more in the tube
    assert not signal.agrees
    assert signal.measures.excess == pytest.approx(0.2 - 0.005 * slope, abs=1e-3)
    assert signal.measures.excess_time == pytest.approx(0.3, abs=0.0051)


def test_a_shift_within_the_tolerance_in_time_agrees_however_steep_the_signal():
    def strike(late):
        return np.exp(-(((TIMES - 0.5 - late) / 0.01) ** 2))

    late = result(strike(0.002)), result(strike(0.0))
    allowed = one(*late, value=0.001, time=0.0021)
    assert allowed.agrees
    assert allowed.measures.shift == pytest.approx(0.002, abs=1e-5)
    assert allowed.measures.relative_difference > 0.15  # the slope is 0.86 / 10 ms
    assert not one(*late, value=0.001, time=0.0015).agrees
    assert one(*late, value=math.inf, shift=0.0019).reasons == ("shift above 0.0019",)


def test_a_jump_at_a_rounded_time_is_the_same_jump():
    """Files with twelve digits round times; without any width a jump would differ all of it."""

    def step(at):
        return result([0.0, 0.0, 1.0, 1.0], times=[0.0, at, at, 1.0])

    pair = step(1.0 / 3.0), step(float(f"{1.0 / 3.0:.12g}"))
    assert one(*pair).agrees
    assert not one(*pair, time=0.0).agrees


def test_jumps_are_not_smoothed():
    step = result([0.0, 0.0, 1.0, 1.0], times=[0.0, 0.5, 0.5, 1.0])
    ramp = result([0.0, 0.0, 1.0, 1.0], times=[0.0, 0.5, 0.6, 1.0])
    measures = one(ramp, step).measures
    assert measures.difference == -1.0
    assert measures.difference_time == 0.5
    assert measures.nrms == pytest.approx(math.sqrt(0.1 / 3.0))


def test_truths_hold_until_the_next_sample():
    coarse = result([True, False, False], times=[0.0, 0.5, 1.0], unit="1")
    fine = result([True, True, False, False], times=[0.0, 0.4, 0.5, 1.0], unit="1")
    assert one(fine, coarse, value=0.0).agrees
    late = result([True, False, False], times=[0.0, 0.6, 1.0], unit="1")
    assert one(late, coarse).measures.nrms == pytest.approx(math.sqrt(0.1))


@settings(max_examples=25)
@given(seed=st.integers(0, 999))
def test_a_polyline_on_other_times_is_the_same_signal(seed):
    """More points on the same straight pieces change nothing but the last digits."""
    rng = np.random.default_rng(seed)
    times = np.unique(np.concatenate([[0.0, 1.0], rng.uniform(size=30)]))
    values = rng.normal(size=times.size)
    more = np.unique(np.concatenate([times, rng.uniform(size=40)]))
    signal = one(result(np.interp(more, times, values), times=more), result(values, times=times))
    assert signal.agrees
    assert signal.measures.relative_difference < 1e-13


def test_a_constant_is_measured_by_its_size():
    signal = one(result(np.full(3, 1.01), times=[0, 1, 2]), result(np.ones(2), times=[0, 2]))
    assert signal.measures.nrms == pytest.approx(0.01)
    assert signal.measures.shift == 0.0


def test_rounding_of_a_constant_is_no_range():
    noisy = 5.0 + 1e-15 * np.sin(40.0 * TIMES)
    assert one(result(noisy), result(np.roll(noisy, 7))).agrees


def test_what_should_be_zero_needs_an_absolute_tolerance():
    zero, noise = result(np.zeros(1001)), result(1e-17 * BUMP)
    strict = one(noise, zero)
    assert not strict.agrees
    assert strict.measures.nrms == math.inf
    assert one(noise, zero, absolute=1e-12).agrees
    numbers = compare(noise, zero).numbers()["signals"]["force"]
    assert numbers["nrms"] is None
    assert numbers["difference"] == 1e-17


@pytest.mark.parametrize("bad", [math.nan, math.inf])
@pytest.mark.parametrize("where", ["result", "baseline", "both"])
def test_what_is_no_number_differs_even_from_itself(bad, where):
    broken = BUMP.copy()
    broken[[100, 200]] = bad
    new = result(BUMP if where == "baseline" else broken)
    old = result(BUMP if where == "result" else broken)
    compared = compare(new, old, Tolerances(default=Tolerance(value=math.inf)))
    assert not compared.agrees
    assert compared.signals[0].measures is None
    assert "2 values that are no finite numbers, the first at 0.1 s" in "".join(
        compared.signals[0].reasons
    )


def test_limits_on_nrms_and_peak_count_without_a_tube():
    pair = result(1.01 * BUMP), result(BUMP)
    assert one(*pair, value=math.inf).agrees
    assert one(*pair, value=math.inf, nrms=0.006).reasons == ("nrms above 0.006",)
    assert one(*pair, value=math.inf, peak=0.009).reasons == ("peak above 0.009",)


def test_a_missing_signal_differs_and_one_more_does_not():
    both = result(BUMP).assign(other=("time", BUMP))
    less = compare(result(BUMP), both)
    assert less.missing == ("other",)
    assert not less.agrees
    more = compare(both, result(BUMP))
    assert more.extra == ("other",)
    assert more.agrees
    assert compare(result(BUMP), both, Tolerances(ignore=("oth*",))).agrees


def test_another_end_differs_unless_only_the_common_interval_is_wanted():
    short = result(BUMP[:501], times=TIMES[:501])
    compared = compare(short, result(BUMP))
    assert compared.interval == (0.0, 0.5)
    assert compared.problems == ("it ends at 0.5 s, the baseline at 1 s",)
    assert not compared.agrees
    assert compare(short, result(BUMP), Tolerances(interval=math.inf)).agrees
    assert compare(short, result(BUMP), Tolerances(interval=0.5)).agrees


def test_numbers_are_those_of_the_common_interval():
    """Half of the bump as the baseline, and a result that goes astray after it."""
    astray = BUMP.copy()
    astray[600:] = 9.0
    half = result(BUMP[:501], times=TIMES[:501])
    measures = compare(result(astray), half, Tolerances(interval=math.inf)).signals[0].measures
    assert measures.difference == 0.0
    assert measures.peak == 1.0


def test_another_unit_differs():
    signal = one(result(BUMP, unit="kN"), result(BUMP))
    assert signal.reasons == ("in kN, baseline in N",)
    assert one(result(BUMP, unit="1"), result(BUMP)).agrees  # none known


def test_facts_that_differ_are_information():
    new = result(BUMP, scenario="[vehicle]\nspeed_kmh = 40\nwheels = 2", wall_time=1.0, only=1)
    old = result(BUMP, scenario="[vehicle]\nspeed_kmh = 60\nwheels = 2", wall_time=2.0)
    compared = compare(new.assign(load=3.0), old.assign(load=4.0))
    assert compared.agrees
    assert [(fact.name, fact.result, fact.baseline) for fact in compared.facts] == [
        ("load", "3.0", "4.0"),
        ("scenario", "speed_kmh = 40", "speed_kmh = 60"),
    ]


def test_patterns_choose_signals_and_those_without_effect_are_told():
    both = result(BUMP).assign(other=("time", BUMP))
    tolerances = Tolerances(signals={"forse": {"value": 1.0}})
    compared = compare(both, both, tolerances, signals=["oth*"])
    assert [signal.name for signal in compared.signals] == ["other"]
    assert compared.notes == ("no signal is of the pattern forse",)


def test_results_without_anything_in_common_are_refused():
    with pytest.raises(InputError, match="none of the signals"):
        compare(result(BUMP, name="a"), result(BUMP, name="b"))
    with pytest.raises(InputError, match="no time in common"):
        compare(result(BUMP), result(BUMP, times=TIMES + 2.0))


def test_the_verdict_names_what_differs():
    assert "agrees with the baseline in 1 signals" in compare(result(BUMP), result(BUMP)).verdict()
    text = compare(result(2.0 * BUMP), result(BUMP)).verdict()
    assert text == "the result differs from the baseline: 1 of 1 signals differ (force)"
