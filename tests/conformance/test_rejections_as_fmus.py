"""What attempts thrown away leave behind in FMUs: nothing, no memory either."""

import sys
from pathlib import Path

import pytest

from orchestrator import ErrorControl, Master, MasterSettings, Recorder
from orchestrator.ssp import open_system
from tests.conformance.systems import oscillator, splits
from tests.throwing import Throwing


def controller():
    return ErrorControl(initial_step=0.02, min_step=1e-9, max_step=0.02)


def trajectory(path, control, observer):
    """Run the masses over one second, landing wherever the first one passes its rest."""
    with open_system(path) as opened:
        return Master(
            opened.system,
            MasterSettings(tolerance=1e-3),
            controller=control,
            events=["first.displacement"],
            observers=[observer],
        ).run(0.0, 1.0)


@pytest.mark.parametrize("split", splits)
def test_attempts_thrown_away_at_random_change_no_bit(put, split):
    path = put(oscillator(split))
    plain, disturbed = Recorder(), Recorder()
    outcome = trajectory(path, controller(), plain)
    throwing = Throwing(controller(), 0.3, seed=1)
    trajectory(path, throwing, disturbed)
    assert outcome.statistics.rejected["error"] > 0
    assert outcome.statistics.switches > 0
    assert throwing.thrown > 0.2 * outcome.statistics.accepted
    assert plain.time.tobytes() == disturbed.time.tobytes()
    assert plain.values.tobytes() == disturbed.values.tobytes()


class Census:
    """Counts live states of the masses, and notes the memory of the process along the run."""

    def __init__(self, steps):
        self.steps, self.count = steps, 0
        self.alive, self.resident = set(), []

    def choose(self, _available):
        return []

    def start(self, _variables, _log):
        sys.modules["conformance_mass"].State.most = 0

    def accepted(self, _time, _values):
        self.count += 1
        self.alive.add(sys.modules["conformance_mass"].State.alive)
        if self.count % (self.steps // 10) == 0:
            pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
            self.resident.append(4096 * pages)

    def finished(self):
        pass


@pytest.mark.parametrize("steps", [1_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_saved_states_do_not_pile_up(put, steps):
    census = Census(steps)
    settings = MasterSettings(tolerance=None, fixed_step=2.0 / steps, min_step=1e-9)
    throwing = Throwing(settings.make_controller(2.0), 0.3, seed=1)
    with open_system(put(oscillator("force/displacement"))) as opened:
        outcome = Master(opened.system, settings, controller=throwing, observers=[census]).run(
            0.0, 2.0
        )
    assert outcome.statistics.accepted == steps
    assert outcome.statistics.rejected["error"] == throwing.thrown > 0.2 * steps
    # One for each of the two masses, and the next one of either before its last one is given up.
    state = sys.modules["conformance_mass"].State
    assert census.alive == {2}
    assert state.most == 3
    assert state.alive == 0
    # A state takes 400 bytes and more; a row of the step log 37, copied as the log grows.
    grown = census.resident[-1] - census.resident[1]
    assert grown < 2**20 + 2 * 2 * 37 * outcome.step_log.size
