import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vehicle_fmu.contact import hertz_compression, hertz_force, hertz_stiffness
from vehicle_fmu.integration import integrate_wheel
from vehicle_fmu.running_surface import surface_over_step

MASS, LOAD, C = 592.5, 117_720.0, 9.17e10
REST = hertz_compression(LOAD, C)


def move(z, v, duration, substeps, surface=None):
    return integrate_wheel(
        z,
        v,
        surface or [0.0] * (2 * substeps + 1),
        step_size=duration,
        mass=MASS,
        load=LOAD,
        coefficient=C,
    )


def energy(z, v):
    spring = 0.4 * C * max(0.0, z) ** 2.5
    return 0.5 * MASS * v * v + spring - LOAD * z


@given(st.floats(-1.0, -0.1), st.floats(-1.0, 1.0), st.integers(1, 50))
def test_free_fall_is_exact_to_rounding(z, v, substeps):
    time = 5e-3
    z_end, v_end = move(z, v, time, substeps)
    assert z_end == pytest.approx(z + v * time + 0.5 * LOAD / MASS * time**2, abs=1e-14)
    assert v_end == pytest.approx(v + LOAD / MASS * time, abs=1e-14)


def test_smooth_motion_converges_with_order_four():
    # From 0.3 to about 1.8 times the static compression, 1.2 periods, never out of contact.
    start, time = 0.3 * REST, 5e-3
    reference = move(start, 0.0, time, 6400)
    errors = [
        math.hypot(z - reference[0], (v - reference[1]) / 1600.0)
        for z, v in (move(start, 0.0, time, n) for n in (50, 100, 200))
    ]
    for coarse, fine in pairwise(errors):
        assert math.log2(coarse / fine) == pytest.approx(4.0, abs=0.15)


def test_smooth_motion_on_a_moving_surface_converges_with_order_four():
    time = 5e-3

    def end(n):
        surface = [2e-5 * math.sin(2000.0 * k * time / (2 * n)) for k in range(2 * n + 1)]
        return move(REST, 0.0, time, n, surface)[0]

    reference = end(6400)
    ratio = (end(100) - reference) / (end(200) - reference)
    assert math.log2(ratio) == pytest.approx(4.0, abs=0.15)


@settings(deadline=None, max_examples=20)
@given(st.floats(1e-5, 3e-3))
def test_bounce_conserves_energy_through_loss_and_recovery(height):
    z, v = -height, 0.0
    total = energy(z, v)
    lowest = highest = z
    recovered = 0
    for _ in range(1500):
        before = z
        z, v = move(z, v, 2e-5, 1)
        recovered += before <= 0.0 < z
        lowest, highest = max(lowest, z), min(highest, z)
        # The switch is the largest error: measured 2e-5 of the energy over the bounces.
        assert energy(z, v) == pytest.approx(total, rel=1e-4)
    assert recovered >= 2
    assert highest == pytest.approx(-height, rel=1e-3)
    # The turning point, missed by up to half a substep, is where the contact holds all the energy.
    assert energy(lowest, 0.0) == pytest.approx(total, rel=5e-3)


def test_small_oscillation_has_the_linearised_contact_frequency():
    omega = math.sqrt(hertz_stiffness(LOAD, C) / MASS)
    assert omega / (2.0 * math.pi) == pytest.approx(252.8, abs=0.1)
    amplitude = 1e-4 * REST
    half, whole = (
        move(REST + amplitude, 0.0, turns * math.pi / omega, 200 * turns) for turns in (1, 2)
    )
    # The law is steeper on compression: half a period later the wheel is further out by the
    # amplitude / (6 REST). What is left is of the second order in 1e-4.
    further = amplitude * (1.0 + amplitude / (6.0 * REST))
    assert half[0] == pytest.approx(REST - further, rel=0.0, abs=1e-7 * amplitude)
    assert whole[0] == pytest.approx(REST + amplitude, rel=0.0, abs=1e-7 * amplitude)
    for _, v in (half, whole):
        assert abs(v) <= 1e-7 * omega * amplitude


@given(st.floats(-1e-2, 1e-2), st.floats(-1e-2, 1e-2), st.integers(1, 20))
def test_surface_ends_at_the_input_and_rises_evenly(start, end, substeps):
    surface = surface_over_step(start, end, [1e-3] * (2 * substeps + 1))
    assert (surface[0], surface[-1]) == (start + 1e-3, end + 1e-3)
    rise = (end - start) / (2 * substeps)
    for k, level in enumerate(surface):
        assert level == pytest.approx(start + k * rise + 1e-3, rel=0.0, abs=1e-17)


def test_nan_surface_gives_nan_and_not_loss_of_contact():
    assert math.isnan(move(REST, 0.0, 1e-4, 1, [0.0, math.nan, 0.0])[0])
    assert hertz_force(REST, C) == pytest.approx(LOAD, rel=1e-14)
