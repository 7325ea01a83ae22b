import io

import pytest
from rich.console import Console

from orchestrator import Candidate, Cause, ErrorControl, Failure
from railcosim.terminal.progress import progress_bar
from railcosim.watched_control import Progress, WatchedControl


def candidate(time, size, *, failure=None, error=0.5):
    return Candidate(time, size, failure, None, error, 1, 0.0)


def make_control():
    return ErrorControl(initial_step=1e-4, min_step=1e-6, max_step=1e-3)


def test_a_watched_control_decides_like_the_other_one_and_tells():
    attempts = [
        candidate(0.0, 1e-4),
        candidate(1e-4, 2e-4, error=3.0),
        candidate(1e-4, 1e-4, failure=Failure(Cause.CONVERGENCE, "slow")),
        candidate(1e-4, 5e-5),
    ]
    seen = []
    watched = WatchedControl(make_control(), stop_time=0.5, report=seen.append)
    plain = make_control()
    assert watched.first_step == plain.first_step
    assert [watched.decide(one) for one in attempts] == [plain.decide(one) for one in attempts]
    assert watched.after_switch() == plain.after_switch()
    assert seen == [
        Progress(1e-4, 0.5, 1e-4, 0),
        Progress(1e-4, 0.5, 2e-4, 1),
        Progress(1e-4, 0.5, 1e-4, 2),
        Progress(pytest.approx(1.5e-4, rel=1e-12), 0.5, 5e-5, 2),
    ]


def test_the_bar_shows_time_step_and_rejections_on_a_terminal():
    file = io.StringIO()
    console = Console(file=file, force_terminal=True, width=120)
    with progress_bar(console) as report:
        report(Progress(0.25, 0.5, 1.5e-4, 7))
    shown = file.getvalue()
    assert "t 0.2500 of 0.5000 s" in shown
    assert "step 150.0 us" in shown
    assert "7 rejected" in shown


def test_nothing_is_shown_where_there_is_no_terminal():
    file = io.StringIO()
    with progress_bar(Console(file=file, force_terminal=False)) as report:
        report(Progress(0.25, 0.5, 1e-4, 0))
    assert file.getvalue() == ""


def test_the_time_left_follows_from_half_a_minute_not_from_the_last_steps():
    """Ten thousand steps a second; those of the last tenth of a second are ten times as fast."""
    now = 0.0
    file = io.StringIO()
    console = Console(file=file, force_terminal=True, width=120, get_time=lambda: now)
    with progress_bar(console) as report:
        for step in range(1000, 300_000, 100):
            now = 1e-4 * step
            report(Progress(now, 60.0, 1e-4, 0))
        for step in range(2000):
            now += 1e-5
            report(Progress(29.99 + 1e-4 * step, 60.0, 1e-4, 0))
    shown = file.getvalue()
    assert "0:00:31" in shown  # 30.01, rounded up
