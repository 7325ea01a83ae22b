"""What the FMUs compute: the same in both versions, inputs over a step, derivatives."""

from ctypes import byref, c_double, c_int, c_size_t

import fmpy
import numpy as np
import pytest

from .fmi_calls import DISCARD, ERROR, OK, references
from .fmi_inputs import INPUTS, OUTPUTS, STEP, both, both_versions, over_the_track, put_all, started


@both
def test_both_versions_give_the_same_bits_in_fmpy(native_fmus, contact_fmus, model):
    times = np.arange(0.0, 0.02, 5e-4)
    columns = list(INPUTS[model](0.0))
    signals = np.array(
        [(t, *INPUTS[model](t).values()) for t in times],
        dtype=[("time", float), *((name, float) for name in columns)],
    )
    results = [
        fmpy.simulate_fmu(
            str(pair.track if model.startswith("track") else pair.vehicle),
            stop_time=0.02,
            output_interval=5e-4,
            input=signals,
            output=OUTPUTS[model],
        )
        for pair in (native_fmus if model in {"track", "vehicle"} else contact_fmus).values()
    ]
    assert len(results[0]) == 41
    for name in OUTPUTS[model]:
        assert np.ptp(results[0][name]) > 0.0
        assert results[0][name].tobytes() == results[1][name].tobytes()


@both
def test_slopes_of_inputs_do_what_linear_inputs_does(fmi, model):
    sloped, linear = fmi(2, model), fmi(2, model)
    started(sloped, model)
    started(linear, model, linear_inputs=True)
    for n in range(20):
        now, then = (INPUTS[model](time) for time in (n * STEP, (n + 1) * STEP))
        put_all(sloped, now)
        set_slopes(sloped, {name: (then[name] - now[name]) / STEP for name in now})
        put_all(linear, then)
        for instance in (sloped, linear):
            instance.must(instance.step(n * STEP, STEP)[0])
        expected = linear.get(*OUTPUTS[model])
        np.testing.assert_allclose(sloped.get(*OUTPUTS[model]), expected, rtol=1e-9)
        assert sloped.get(*then) == pytest.approx(list(then.values()), rel=1e-14)


def set_slopes(instance, slopes, order=1):
    status = instance.call(
        "SetRealInputDerivatives",
        references([instance.number[name] for name in slopes]),
        c_size_t(len(slopes)),
        (c_int * len(slopes))(*[order] * len(slopes)),
        (c_double * len(slopes))(*slopes.values()),
    )
    assert status == (OK if order == 1 else ERROR)


@both
def test_slopes_are_part_of_a_state_and_survive_a_discarded_step(fmi, model):
    instance = started(fmi(2, model), model)
    instance.must(instance.step(0.0, STEP)[0])
    now = instance.get(*INPUTS[model](0.0))
    slopes = dict.fromkeys(INPUTS[model](0.0), 10.0)
    set_slopes(instance, slopes)
    state = instance.save()
    assert instance.step(STEP, -1.0)[0] == DISCARD
    assert instance.get(*slopes) == now
    instance.must(instance.step(STEP, STEP)[0])
    first = instance.get(*OUTPUTS[model])
    instance.must(instance.step(2 * STEP, STEP)[0])
    assert instance.get(*OUTPUTS[model]) != first
    instance.must(instance.call("SetFMUstate", state))
    instance.must(instance.step(STEP, STEP)[0])
    assert instance.get(*OUTPUTS[model]) == first
    set_slopes(instance, slopes, order=2)
    instance.must(instance.call("FreeFMUstate", byref(state)))


def test_slopes_count_for_one_step(fmi):
    instance = started(fmi(2, "vehicle"), "vehicle")
    one, other = (f"wheel[{k}].rail_displacement" for k in (1, 2))
    set_slopes(instance, {one: 10.0, other: 10.0})
    instance.must(instance.step(0.0, STEP)[0])
    before = instance.get(one, other)
    set_slopes(instance, {other: 1.0})
    instance.must(instance.step(STEP, STEP)[0])
    assert instance.get(one, other) == [before[0], before[1] + STEP * 1.0]


@both_versions
def test_the_slope_of_the_rail_is_its_velocity(fmi, version):
    instance = started(fmi(version, "track"), "track")
    for n in range(5):
        put_all(instance, over_the_track(n * STEP))
        instance.must(instance.step(n * STEP, STEP)[0])
    names = [f"wheel[{k}].rail_displacement" for k in (1, 2)]
    assert output_slopes(instance, names) == (
        OK,
        instance.get("wheel[1].rail_velocity", "wheel[2].rail_velocity"),
    )
    assert output_slopes(instance, ["pad[1].force"])[0] == DISCARD
    assert instance.message.replace("##", "#") == "the derivative of pad[1].force is not known"
    assert output_slopes(instance, ["wheel[1].position"])[0] == ERROR
    assert output_slopes(instance, names, order=2)[0] == ERROR


def output_slopes(instance, names, order=1):
    values = (c_double * len(names))()
    name = "GetRealOutputDerivatives" if instance.version == 2 else "GetOutputDerivatives"
    status = instance.call(
        name,
        references([instance.number[name] for name in names]),
        c_size_t(len(names)),
        (c_int * len(names))(*[order] * len(names)),
        values,
        *instance.n(len(names)),
    )
    return status, list(values)


@both_versions
@both
def test_directional_derivatives_are_those_over_the_last_step(fmi, version, model):
    """Differences of repeated steps: linear to 1e-6 for a change of 1e-4 of the inputs."""
    instance = started(fmi(version, model), model)
    kind = {"vehicle": "rail_displacement", "track_contact": "displacement"}.get(
        model, "contact_force"
    )
    knowns = [f"wheel[{k}].{kind}" for k in (1, 2)]
    unknowns = OUTPUTS[model]
    assert instance.sensitivity(unknowns, knowns, [1.0, 0.0])[0] == DISCARD
    state = instance.save()
    matrix = []
    for k in range(2):
        change = 10.0 if kind == "contact_force" else 1e-8
        ends = []
        for sign in (1.0, -1.0):
            instance.must(instance.call("SetFMUstate", state))
            put_all(instance, {knowns[k]: INPUTS[model](0.0)[knowns[k]] + sign * change})
            instance.must(instance.step(0.0, STEP)[0])
            ends.append(np.array(instance.get(*unknowns)))
        matrix.append((ends[0] - ends[1]) / (2.0 * change))
    instance.must(instance.call("SetFMUstate", state))
    instance.must(instance.step(0.0, STEP)[0])
    for k in range(2):
        status, found = instance.sensitivity(unknowns, knowns, [float(k == 0), float(k == 1)])
        assert status == OK
        np.testing.assert_allclose(found, matrix[k], rtol=1e-5, atol=1e-6 * np.max(np.abs(matrix)))
    if version == 3:
        seed = [1.0, -2.0, 0.5, 3.0]
        status, found = instance.sensitivity(unknowns, knowns, seed, adjoint=True)
        assert status == OK
        forward = [instance.sensitivity(unknowns, knowns, s)[1] for s in ([1.0, 0.0], [0.0, 1.0])]
        np.testing.assert_allclose(found, np.array(forward) @ seed, rtol=1e-12)
    instance.must(instance.call("FreeFMUstate", byref(state)))


def test_steps_end_at_switches_of_contact_if_the_host_allows_it(fmi):
    """The rail falls away under a wheel: contact is lost within the step, to 1e-9 s."""
    whole, early = fmi(3, "vehicle").start(), fmi(3, "vehicle", early_return=True).start()
    for instance in (whole, early):
        instance.must(instance.put("wheel[1].rail_displacement", 5e-3))
    assert whole.step(0.0, 1e-3) == (OK, 1e-3)
    assert not whole.early
    held, reached = early.step(0.0, 1e-3)
    assert held == OK
    assert early.early
    assert 0.0 < reached <= 1e-9, "the rail is held away from the start on"
    linear = fmi(3, "vehicle", early_return=True).start(linear_inputs=True)
    linear.must(linear.put("wheel[1].rail_displacement", 5e-3))
    status, reached = linear.step(0.0, 1e-3)
    assert (status, linear.early) == (OK, True)
    gap = linear.get("wheel[1].gap")[0]
    assert 0.0 < gap < 1e-8
    share = reached / 1e-3
    assert linear.get("wheel[1].rail_displacement")[0] == pytest.approx(share * 5e-3, rel=1e-12)
    linear.must(linear.put("wheel[1].rail_displacement", 5e-3))
    assert linear.step(reached, 1e-3 - reached) == (OK, 1e-3)
    assert not linear.early
