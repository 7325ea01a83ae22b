"""Values that do not fit their declarations or the tolerance: none of it passes in silence."""

from math import exp

import numpy as np
import pytest
from fake_participants import Linear, static, wire

from orchestrator import Master, MasterSettings, Recorder, System, WiringError


def clock(**options):
    return Linear(
        "clock",
        inputs=[],
        outputs=["y"],
        A=[[0]],
        B=np.zeros((1, 0)),
        C=[[1]],
        D=np.zeros((1, 0)),
        c=[1],
        x0=[0],
        **options,
    )


class Held(Linear):
    """Takes its inputs held, whatever it is asked for."""

    def bind(self, **options):
        super().bind(**options | {"input_shape": "held"})


def integrator(name, *, kind=Linear, x0=0.0, rate=1.0, outputs=("y",), **options):
    n = len(outputs)
    return kind(
        name,
        inputs=["u"],
        outputs=list(outputs),
        A=[[0]],
        B=[[rate]],
        C=np.ones((n, 1)),
        D=np.zeros((n, 1)),
        x0=[x0],
        **options,
    )


def run(system, **settings):
    recorder = Recorder()
    outcome = Master(system, MasterSettings(**settings), observers=[recorder]).run(0.0, 1.0)
    return outcome, recorder


def decay(*, x0=1.0, rate=-1.0, **options):
    """y' = rate y, as an integrator that drives itself."""
    body = integrator("body", x0=x0, rate=rate, **options)
    return System([body], [wire("body.y", "body.u")])


def test_held_inputs_that_no_tolerance_sees_are_a_doubt():
    system = System([clock(), integrator("body", kind=Held)], [wire("clock.y", "body.u")])
    outcome, recorder = run(system, tolerance=1e-4)
    # Held at its end the ramp is h / 2 too high over a step h, which is 0.1 in the end.
    assert recorder["body.y"][-1] - 0.5 > 0.04
    (warning,) = outcome.warnings
    assert warning.startswith("body holds its inputs over every step, in which clock.y changed by")
    assert "in body.y is of first order" in warning


def test_lines_and_values_under_control_and_fixed_steps_are_none():
    lines = System([clock(), integrator("body")], [wire("clock.y", "body.u")])
    assert run(lines, tolerance=1e-4)[0].warnings == ()
    held = System([clock(), integrator("body", kind=Held)], [wire("clock.y", "body.u")])
    assert run(held, tolerance=None, fixed_step=0.1)[0].warnings == ()
    assert run(decay(kind=Held), tolerance=1e-4)[0].warnings == ()


@pytest.mark.parametrize("settings", [{"tolerance": 1e-4}, {"tolerance": None, "fixed_step": 0.1}])
def test_values_below_what_their_nominal_value_lets_pass_are_a_doubt(settings):
    amplitude = 1e-7
    outcome, recorder = run(decay(x0=amplitude, rate=-10.0), **settings)
    # The reason for the warning: some percent of the largest value and more are lost.
    assert abs(recorder["body.y"] - amplitude * np.exp(-10.0 * recorder.time)).max() > 0.01e-7
    (warning,) = outcome.warnings
    assert warning.startswith("body.y never exceeded 1e-07, so that an error of ")


def test_a_nominal_value_of_their_magnitude_helps():
    system = decay(x0=1e-7, rate=-10.0, details={"y": {"nominal": 1e-7}})
    outcome, recorder = run(system, tolerance=1e-4)
    assert outcome.warnings == ()
    assert recorder["body.y"][-1] == pytest.approx(1e-7 * exp(-10.0), abs=1e-11)


def test_a_value_that_stays_zero_is_none():
    assert run(decay(x0=0.0), tolerance=1e-4)[0].warnings == ()


@pytest.mark.parametrize("algorithm", ["gauss_seidel", "jacobi"])
def test_a_value_that_leaves_its_bounds_is_followed_and_a_doubt(algorithm):
    system = decay(details={"y": {"minimum": 0.5}})
    outcome, recorder = run(system, tolerance=None, fixed_step=0.01, algorithm=algorithm)
    # Second order: the error of extrapolated inputs is about 5/12 h^2.
    assert recorder["body.y"][-1] == pytest.approx(exp(-1.0), abs=1e-4)
    (warning,) = outcome.warnings
    assert warning.startswith("body.y came to 0.4")
    assert "[0.5, inf]" in warning


def test_a_value_without_a_loop_is_followed_beyond_its_bounds():
    gain = static("gain", inputs=["u"], outputs=["y"], D=[[2]], details={"u": {"maximum": 0.5}})
    outcome, recorder = run(System([clock(), gain], [wire("clock.y", "gain.u")]), tolerance=1e-3)
    assert recorder["gain.y"][-1] == pytest.approx(2.0, abs=1e-12)
    assert outcome.warnings[0].startswith("clock.y came to 1, outside")
    assert outcome.statistics.accepted < 100


def test_an_implicit_loop_does_not_leave_its_bounds():
    with pytest.raises(Exception, match=r"body\.y \(kept at its bound 0\.5\) is left with"):
        run(decay(details={"y": {"minimum": 0.5}}), tolerance=1e-4)


def test_only_outputs_are_indicators():
    system = decay()
    with pytest.raises(WiringError, match="of the causality input"):
        Master(system, MasterSettings(tolerance=1e-3), events=["body.u"]).run(0.0, 1.0)
