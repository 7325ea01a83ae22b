"""The two FMUs coupled by the master of this project."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from overhead.system import PARTNERS, STEP, Sample

from orchestrator import (
    Connection,
    FmuParticipant,
    IsolatedParticipant,
    Master,
    MasterSettings,
    Recorder,
    System,
    Variable,
)
from orchestrator.step_log import StepLog

OUTPUTS = ("left.y", "right.y")


class Stopwatch:
    """Observer that times the loop, without setting up and cleaning up."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def choose(self, _available: Mapping[str, Variable]) -> Sequence[str]:
        """Return nothing."""
        return ()

    def start(self, _variables: Mapping[str, Variable], _log: StepLog) -> None:
        """Start."""
        self.seconds -= perf_counter()

    def accepted(self, _time: float, _values: object) -> None:
        """Pass."""

    def finished(self) -> None:
        """Stop."""
        self.seconds += perf_counter()


@dataclass(frozen=True, slots=True, kw_only=True)
class Coupled:
    """A way to run them.

    Attributes
    ----------
    settings : MasterSettings
        Settings of the master.
    recorded : bool
        Whether a recorder keeps both outputs.
    isolated : bool
        Whether each FMU runs in a process of its own.
    """

    settings: MasterSettings
    recorded: bool = False
    isolated: bool = False

    def __call__(self, fmu: Path, steps: int) -> Sample:
        """Run so many macro steps."""
        return self._run(fmu, steps, recorded=self.recorded)

    def final(self, fmu: Path, steps: int) -> tuple[float, float]:
        """Return the last outputs, for which a recorder is needed."""
        final = self._run(fmu, steps, recorded=True).final
        assert final is not None
        return final

    def _run(self, fmu: Path, steps: int, *, recorded: bool) -> Sample:
        kind = IsolatedParticipant if self.isolated else FmuParticipant
        system = System(
            [kind(fmu, name=name, start_values=values) for name, values in PARTNERS.items()],
            [
                Connection(source="left.y", target="right.u"),
                Connection(source="right.y", target="left.u"),
            ],
        )
        watch, recorder = Stopwatch(), Recorder(OUTPUTS)
        observers = [recorder, watch] if recorded else [watch]
        outcome = Master(system, self.settings, observers=observers).run(0.0, steps * STEP)
        left, right = (recorder[name][-1] if recorded else 0.0 for name in OUTPUTS)
        return Sample(
            microseconds=1e6 * watch.seconds / outcome.statistics.accepted,
            final=(left, right) if recorded else None,
            iterations=outcome.statistics.iterations / outcome.statistics.accepted,
        )


def settings(algorithm: str, *, extrapolate: bool = False) -> MasterSettings:
    """Return settings for fixed steps."""
    return MasterSettings(
        tolerance=None, algorithm=algorithm, fixed_step=STEP, extrapolate=extrapolate
    )


controlled = MasterSettings(tolerance=1e3, initial_step=STEP, max_step=STEP)
"""Error control that has nothing to object to: but for the first ones, the steps are the same."""
