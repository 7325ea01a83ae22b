"""The energy that connections add, against the energy that participants have."""

import numpy as np
import pytest
from fake_participants import Linear, oscillators

from orchestrator import Bond, Master, MasterSettings, System, WiringError, bond_by_unit

k = kc = 10.0
by_displacement = Bond(force="second.force", motion="first.displacement", kind="displacement")
by_velocity = Bond(force="second.force", motion="first.velocity", kind="velocity")


def energy(x1, v1, x2, v2, x1_seen):
    """Energy of both masses; the coupling spring belongs to the second one."""
    return 0.5 * (v1**2 + v2**2 + k * x1**2 + k * x2**2 + kc * (x1_seen - x2) ** 2)


def run(steps, bond=by_displacement, **settings):
    """Return the report of the bond and the energy gained, without any damping."""
    chosen = MasterSettings(tolerance=None, fixed_step=2.0 / steps, **settings)
    system = oscillators(k=k, kc=kc, dc=0.0)
    outcome = Master(system, chosen, bonds=[bond]).run(0.0, 2.0)
    first, second = system.participants
    gained = energy(*first.state, *second.state, second.values[0]) - energy(1, 0, 0, 0, 1)
    return outcome, gained


cases = [
    ({"algorithm": "newton", "coupling_tolerance": 1e-12}, 2),
    ({"algorithm": "jacobi"}, 2),
    ({"algorithm": "gauss_seidel", "extrapolate": False}, 1),
    ({"algorithm": "jacobi", "extrapolate": False}, 1),
]


@pytest.mark.parametrize(("settings", "order"), cases)
def test_the_ledger_shrinks_with_the_order_of_the_coupling(settings, order):
    found = [run(steps, **settings) for steps in (200, 400, 800)]
    residuals = np.array([outcome.bonds[0].residual for outcome, _ in found])
    # Extrapolation and the first step without a past add a term of the next order.
    observed = np.log2(residuals[:-1] / residuals[1:])
    assert observed == pytest.approx([order, order], abs=0.35)
    assert abs(observed[1] - order) < abs(observed[0] - order) + 0.02
    for outcome, gained in found:
        # Energy that the motion's side saw and the other did not is lost. The spring answers within
        # a step to what it is given, which the ledger cannot see: hence the factor.
        assert 0.5 < -gained / outcome.bonds[0].residual < 1.1


@pytest.mark.parametrize(("settings", "order"), [cases[0], cases[3]])
def test_a_bond_may_be_given_by_the_velocity(settings, order):
    found = [run(steps, by_velocity, **settings)[0].bonds[0] for steps in (200, 400, 800)]
    residuals = np.array([item.largest for item in found])
    assert np.log2(residuals[:-1] / residuals[1:]) == pytest.approx([order, order], abs=0.35)
    work = run(800)[0].bonds[0].exchanged
    assert found[-1].exchanged == pytest.approx(work, rel=0.05)


def test_much_made_or_lost_is_warned_of():
    quiet, _ = run(200)
    assert quiet.warnings == ()
    loud, _ = run(100, algorithm="jacobi", extrapolate=False)
    assert loud.bonds[0].relative > 0.01
    (warning,) = loud.warnings
    assert "second.force and first.displacement made or lost" in warning


def test_the_ledger_leaves_the_run_alone():
    settings = MasterSettings(tolerance=1e-3, max_step=0.1)
    plain, watched = oscillators(), oscillators()
    Master(plain, settings).run(0.0, 1.0)
    Master(watched, settings, bonds=[by_displacement]).run(0.0, 1.0)
    for one, other in zip(plain.participants, watched.participants, strict=True):
        assert one.state.tobytes() == other.state.tobytes()


def test_what_is_no_bond_is_refused():
    bond = Bond(force="second.force", motion="second.own_displacement", kind="displacement")
    with pytest.raises(WiringError, match="each has to drive the participant of the other one"):
        run(10, bond)


def moving(unit):
    matrices = {"A": [[0]], "B": [[1]], "C": [[1]], "D": [[0]], "x0": [0]}
    details = {"y": {"unit": unit}}
    return System([Linear("a", inputs=["u"], outputs=["y"], details=details, **matrices)], [])


def test_the_unit_says_what_the_motion_is():
    kinds = {unit: bond_by_unit(moving(unit), "a.y", "a.y").kind for unit in ("m", "rad", "m/s")}
    assert kinds == {"m": "displacement", "rad": "displacement", "m/s": "velocity"}
    said = {None: "declares no unit", "N": "has the unit 'N'", "m/s2": "has the unit 'm/s2'"}
    for unit, words in said.items():
        with pytest.raises(WiringError, match=f"a.y {words}"):
            bond_by_unit(moving(unit), "a.y", "a.y")
