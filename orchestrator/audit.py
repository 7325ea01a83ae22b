"""Steps repeated in halves: an error that is measured, to judge the one that is estimated."""

from collections.abc import Sequence

import numpy as np

from .audit_report import AuditReport
from .coupling import Coupling
from .exchange import Exchange
from .participant import Vector
from .stage import Stage

negligible = 1e-12
"""Values that stay below this, over the nominal value, are rounding and not judged."""


class Audit:
    """Repeats every so many accepted steps in two halves and leaves everything as it was.

    The difference is Richardson's measure of the local error (Hairer, Norsett & Wanner, Solving
    ODEs I, section II.4). It is judged by the magnitude that the values really have, not by their
    nominal values, which the estimate has to believe.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    coupling : Coupling
        Finds the exchanged values of a step.
    stages : sequence of Stage
        All participants; each has its state at the start of the step saved.
    every : int
        Number of accepted steps from one audit to the next.
    tolerance : float or None
        Tolerance of the error control.
    """

    def __init__(
        self,
        exchange: Exchange,
        coupling: Coupling,
        stages: Sequence[Stage],
        *,
        every: int,
        tolerance: float | None,
    ) -> None:
        self._exchange = exchange
        self._coupling = coupling
        self._stages = stages
        self._every = every
        self._tolerance = tolerance
        self._count = 0
        self._steps = self._failed = self._underestimated = 0
        size = exchange.nominal.size
        self._differences: Vector = np.zeros(size)
        self._magnitudes: Vector = np.zeros(size)

    def accept(self, time: float, step_size: float, last: Vector, predicted: Vector) -> bool:
        """Repeat the accepted step that began at `time` [s] if it is its turn.

        Parameters
        ----------
        time, step_size : float
            The step [s]; its result is in the participants and in the flat arrays.
        last, predicted : numpy.ndarray, shape (n_values,)
            Exchanged values at its start and those expected at its end.

        Returns
        -------
        bool
            Whether it was repeated; the states at its end are saved then.
        """
        self._count += 1
        if self._count < self._every:
            return False
        self._count = 0
        exchange = self._exchange
        inputs, outputs = exchange.inputs.copy(), exchange.outputs.copy()
        ends = [stage.participant.save() for stage in self._stages]
        try:
            halved = self._halve(time, 0.5 * step_size, last, predicted)
        finally:
            for stage, end in zip(self._stages, ends, strict=True):
                stage.adopt(end)
            exchange.inputs[:], exchange.outputs[:] = inputs, outputs
        self._compare(outputs[exchange.value_places], halved, last, predicted)
        return True

    def report(self) -> AuditReport:
        """Return what was found so far."""
        judged = self._magnitudes > negligible * self._exchange.nominal
        relative = np.divide(
            self._differences, self._magnitudes, out=np.zeros(judged.size), where=judged
        )
        worst = int(np.argmax(relative)) if relative.any() else None
        found = 0.0 if worst is None else float(relative[worst])
        return AuditReport(
            steps=self._steps,
            failed=self._failed,
            underestimated=self._underestimated,
            variable="" if worst is None else self._exchange.value_names[worst],
            difference=0.0 if worst is None else float(self._differences[worst]),
            relative=found,
            optimism=None if self._tolerance is None else found / self._tolerance,
        )

    def warnings(self) -> list[str]:
        """Return a sentence if steps were less accurate than the tolerance says."""
        report = self.report()
        if report.optimism is None or not report.optimism > 1.0:
            return []
        place = self._exchange.value_names.index(report.variable)
        warning = (
            f"The audit measured a difference of {report.difference:.3g} in {report.variable} "
            f"between one step and two halves, {report.optimism:.3g} times the tolerance of its "
            f"largest magnitude {self._magnitudes[place]:.3g}; its nominal value "
            f"{self._exchange.nominal[place]:.3g} should be near that, or the tolerance smaller."
        )
        return [warning]

    def _halve(self, time: float, half: float, last: Vector, predicted: Vector) -> Vector | None:
        """Return the values after two half steps, or None where they have no result."""
        places = self._exchange.value_places
        if self._coupling.attempt(time, half, last, 0.5 * (last + predicted)).failure is not None:
            return None
        middle = self._exchange.outputs[places]
        for stage in self._stages:
            stage.save()
        expected = np.clip(2.0 * middle - last, self._exchange.lower, self._exchange.upper)
        if self._coupling.attempt(time + half, half, middle, expected).failure is not None:
            return None
        return self._exchange.outputs[places]

    def _compare(
        self, values: Vector, halved: Vector | None, last: Vector, predicted: Vector
    ) -> None:
        self._steps += 1
        np.maximum(self._magnitudes, np.maximum(abs(values), abs(last)), out=self._magnitudes)
        if halved is None:
            self._failed += 1
            return
        difference = abs(halved - values) * self._exchange.continuous
        nominal = self._exchange.nominal
        missed = (abs(values - predicted) * self._exchange.continuous / nominal).max(initial=0.0)
        self._underestimated += bool((difference / nominal).max(initial=0.0) > missed)
        np.maximum(self._differences, difference, out=self._differences)
