"""One attempted step: predicted, coupled, looked at and decided on."""

import numpy as np

from .clock import Step
from .coupling import Coupling
from .decision import Accept, Candidate, Cause, Decision
from .events import Switches
from .exchange import Exchange
from .explanation import explain
from .observation import Observation
from .participant import Vector
from .prediction import History
from .quasi_newton import largest
from .step_control import StepController

nan = float("nan")


class Attempts:
    """Tries steps from the accepted point.

    Parameters
    ----------
    exchange : Exchange
        Participants and the values between them.
    coupling : Coupling
        Finds the exchanged values of a step.
    controller : StepController
        Decides on attempts.
    switches : Switches
        Locates changes of side of the indicators.
    observation : Observation
        Reads the observed values of a step that would be accepted.
    predicts : bool
        Whether anything needs the prediction of exchanged values.
    tolerance : float or None
        Allowed error of a step over the nominal values.

    Attributes
    ----------
    history : History
        Exchanged values at the accepted point, and their slope.
    predicted : numpy.ndarray, shape (n_values,)
        What the last attempt expected.
    """

    def __init__(
        self,
        *,
        exchange: Exchange,
        coupling: Coupling,
        controller: StepController,
        switches: Switches,
        observation: Observation,
        predicts: bool,
        tolerance: float | None,
    ) -> None:
        self.history = History(exchange.lower, exchange.upper)
        self.predicted: Vector = self.history.last
        self._exchange = exchange
        self._coupling = coupling
        self._controller = controller
        self._switches = switches
        self._has_events = bool(switches.names)
        self._observation = observation
        self._predicts = predicts
        self._weights: Vector = exchange.continuous / (exchange.nominal * (tolerance or 1.0))
        # What has no continuous value to predict makes no error that could be seen.
        self._unpredicted = nan if exchange.continuous.any() else 0.0

    def make(self, step: Step) -> tuple[Candidate, Decision]:
        """Try a step; participants are left at its end."""
        candidate = self._attempt(step)
        decision = self._controller.decide(candidate)
        if isinstance(decision, Accept):
            failure = self._observation.read(step.start, step.size)
            if failure is not None:
                candidate = candidate._replace(failure=failure)
                decision = self._controller.decide(candidate)
        return candidate, decision

    def explain(self, candidate: Candidate, cause: Cause) -> str:
        """Return why the last attempt was rejected, as a clause."""
        exchange = self._exchange
        values = exchange.outputs[exchange.value_places]
        return explain(candidate, cause, exchange, np.abs(values - self.predicted) * self._weights)

    def _attempt(self, step: Step) -> Candidate:
        time, size, _ = step
        history, outputs = self.history, self._exchange.outputs
        predicted = history.predict(size) if self._predicts else history.last
        self.predicted = predicted
        failure, iterations, residual = self._coupling.attempt(time, size, history.last, predicted)
        finding, error = None, nan
        if failure is None:
            if self._has_events:
                indicators = outputs[self._exchange.indicator_places].tolist()
                finding = self._switches.examine(size, indicators)
            if self._controller.uses_error:
                error = self._unpredicted
                if history.has_slope:
                    values = outputs[self._exchange.value_places]
                    miss = largest((values - predicted) * self._weights)
                    error = miss * history.curvature_factor(size)
        return Candidate(time, size, failure, finding, error, iterations, residual)
