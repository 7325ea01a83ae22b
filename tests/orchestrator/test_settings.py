"""Settings are checked when they are made."""

import pytest

from orchestrator import ErrorControl, FixedStep, MasterSettings, SettingsError


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tolerance": None}, "give a tolerance, or a fixed_step"),
        ({"tolerance": 0.0}, r"tolerance = 0\.0 must be positive"),
        ({"tolerance": float("nan")}, "tolerance = nan must be positive and finite"),
        ({"tolerance": 1.0, "algorithm": "euler"}, "algorithm 'euler' is none of 'newton'"),
        ({"tolerance": 1.0, "max_step": -1.0}, r"max_step = -1\.0 must be positive"),
        ({"tolerance": 1.0, "max_iterations": 0}, "max_iterations = 0 must be at least 1"),
        ({"tolerance": 1.0, "max_attempts": 0}, "max_attempts = 0 must be at least 1"),
        ({"tolerance": None, "fixed_step": 0.1, "max_step": 1.0}, "fixed_step leaves no choice"),
        ({"tolerance": None, "fixed_step": 0.1, "min_step": 0.2}, "must not exceed fixed_step"),
    ],
)
def test_settings_out_of_range_are_refused(options, message):
    with pytest.raises(SettingsError, match=message):
        MasterSettings(**options)


def test_the_tolerance_has_no_default():
    with pytest.raises(TypeError, match="tolerance"):
        MasterSettings()


def test_step_sizes_follow_from_each_other():
    controller = MasterSettings(tolerance=1.0).make_controller(10.0)
    assert isinstance(controller, ErrorControl)
    assert 0.8 * 0.01 < controller.first_step <= 0.01
    assert controller.min_step == 1e-6
    fixed = MasterSettings(tolerance=None, fixed_step=0.1).make_controller(10.0)
    assert isinstance(fixed, FixedStep)
    assert (fixed.first_step, fixed.min_step, fixed.may_reject) == (0.1, 0.1, False)


def test_contradicting_steps_are_refused():
    with pytest.raises(SettingsError, match="0 < smallest <= initial <= largest"):
        MasterSettings(tolerance=1.0, min_step=0.2, max_step=0.1).make_controller(1.0)
