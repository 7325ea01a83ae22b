import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from railcosim.comparison.polyline import Polyline


def line(times, values, **options):
    return Polyline.through(np.asarray(times, dtype=float), np.asarray(values), **options)


def test_a_time_that_stands_twice_is_a_jump():
    signal = line([0.0, 1.0, 1.0, 2.0], [0.0, 2.0, 5.0, 7.0])
    before, after = signal.at(np.array([0.0, 0.5, 1.0, 1.5, 2.0]))
    assert before.tolist() == [0.0, 1.0, 2.0, 6.0, 7.0]
    assert after.tolist() == [0.0, 1.0, 5.0, 6.0, 7.0]


def test_of_more_rows_with_a_time_the_first_and_the_last_count():
    signal = line([0.0, 1.0, 1.0, 1.0, 2.0], [0.0, 2.0, 99.0, 5.0, 7.0])
    assert [side.tolist() for side in signal.at(np.array([1.0]))] == [[2.0], [5.0]]
    assert signal.bounds() == (0.0, 7.0)


def test_a_held_signal_jumps_at_the_new_sample():
    signal = line([0.0, 1.0, 2.0], [True, False, True], held=True)
    before, after = signal.at(np.array([0.5, 1.0, 1.999, 2.0]))
    assert before.tolist() == [1.0, 1.0, 0.0, 0.0]
    assert after.tolist() == [1.0, 0.0, 0.0, 1.0]


def test_first_and_last_values_continue():
    signal = line([0.0, 1.0], [3.0, 4.0])
    assert [side.tolist() for side in signal.at(np.array([-1.0, 9.0]))] == [[3.0, 4.0]] * 2


def test_a_part_keeps_its_values_and_the_jumps_inside():
    signal = line([0.0, 1.0, 1.0, 2.0], [0.0, 2.0, 5.0, 7.0])
    part = signal.cut(0.5, 1.5)
    assert part.times.tolist() == [0.5, 1.0, 1.5]
    assert part.before.tolist() == [1.0, 2.0, 6.0]
    assert part.after.tolist() == [1.0, 5.0, 6.0]


def test_a_part_that_begins_at_a_jump_begins_after_it():
    signal = line([0.0, 1.0, 1.0, 2.0], [0.0, 2.0, 5.0, 7.0])
    assert signal.cut(1.0, 2.0).bounds() == (5.0, 7.0)
    assert signal.cut(0.0, 1.0).bounds() == (0.0, 2.0)


@given(
    values=st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=60),
    seed=st.integers(0, 99),
    half_width=st.floats(0.0, 70.0),
)
def test_extremes_close_to_a_time_are_those_of_all_values_there(values, seed, half_width):
    steps = np.random.default_rng(seed).choice([0.0, 0.5, 1.0, 3.0], len(values) - 1)
    times = np.concatenate([[0.0], np.cumsum(steps)])
    if times[-1] == 0.0:
        times[-1] = 1.0
    signal = line(times, values)
    asked = np.array([times[0], 0.3 * times[-1], times[len(times) // 2], times[-1]])
    lowest, highest = signal.extremes(asked, half_width)
    for k, time in enumerate(asked):
        ends = np.clip([time - half_width, time + half_width], 0.0, times[-1])
        inside = signal.times[(signal.times >= ends[0]) & (signal.times <= ends[1])]
        seen = np.concatenate(signal.at(np.concatenate([ends, inside])))
        assert lowest[k] == seen.min()
        assert highest[k] == seen.max()
