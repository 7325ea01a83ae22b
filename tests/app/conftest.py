import numpy as np
import pytest

from railcosim.dataset import assemble, count
from railcosim.run_record import ATTEMPT_COLUMNS
from railcosim.scenario import Scenario
from railcosim.signals import SIGNALS
from railcosim.summary import CAUSES


@pytest.fixture
def make_passage():
    """Make a result by hand: given series, zero for every other one."""

    def make(distance, scenario=None, *, series=None, complete=True, unreliable=""):
        scenario = scenario or Scenario()
        distance = np.asarray(distance, dtype=float)
        times = (distance - distance[0]) / scenario.vehicle.constant_speed
        flat = scenario.flat.wheel - 1
        offsets = np.array(scenario.vehicle.offsets)
        base = offsets[flat] - offsets
        values = {
            signal.name: np.zeros((times.size, count(scenario)[signal.dim])) for signal in SIGNALS
        }
        values["wheel_position"] = scenario.flat_position + distance[:, None] + base
        values["gap"] -= 1e-4
        values["in_contact"] += 1.0
        for name, columns in (series or {}).items():
            for k, column in columns.items():
                values[name][:, k - 1] = column
        attempts = dict.fromkeys(ATTEMPT_COLUMNS, np.array([1.0, 2.0]))
        rejected = {f"steps_rejected_{cause}": n for n, cause in enumerate(CAUSES)}
        return assemble(
            scenario,
            times=times,
            series=values,
            attempts=attempts | {"cause": np.array(["accepted", "error"])},
            attributes={
                "fmus": "native",
                "contact": "vehicle",
                "complete": int(complete),
                "stop_reason": "it was interrupted",
                "simulated_time": float(times[-1]),
                "wall_time": 1.5,
                "iterations": 7,
                "steps_accepted": times.size - 1,
                "warnings": "",
                "unreliable": unreliable,
                **rejected,
            },
        )

    return make
