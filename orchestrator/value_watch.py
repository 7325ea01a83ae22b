"""What the exchanged values do that tolerances and declarations do not expect."""

import numpy as np

from .errors import list_names
from .exchange import Exchange
from .participant import Vector
from .stage import Stage

sampled = 16
"""Values are looked at in the first so many steps, and then in every so many-th."""

seen = 10.0
"""A value is too small for its nominal value below this many tolerances of it."""


class ValueWatch:
    """Looks at accepted values: their bounds, their magnitudes and how far held inputs jump.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    controlled : float or None
        Tolerance of the error control; None without one.
    resolved : float or None
        Tolerance of the exchanged values relative to their nominal values, whichever kind applies;
        None where nothing is measured against nominal values.
    """

    def __init__(
        self, exchange: Exchange, *, controlled: float | None, resolved: float | None
    ) -> None:
        self._exchange = exchange
        self._controlled = controlled
        self._resolved = resolved
        self._count = 0
        size = exchange.nominal.size
        self._peaks: Vector = np.zeros(size)
        self._jumps: Vector = np.zeros(size)
        slack = 1e-6 * exchange.nominal
        self._lower: Vector = exchange.lower - slack
        self._upper: Vector = exchange.upper + slack
        self._bounded = bool((np.isfinite(exchange.lower) | np.isfinite(exchange.upper)).any())
        self._outside: dict[int, float] = {}

    def accept(self, values: Vector, last: Vector) -> None:
        """Look at the values of an accepted step and at those before it, shape (n_values,)."""
        if self._bounded:
            self._check_bounds(values)
        self._count += 1
        if self._count > sampled and self._count % sampled:
            return
        np.maximum(self._peaks, np.abs(last), out=self._peaks)
        np.maximum(self._peaks, np.abs(values), out=self._peaks)
        np.maximum(self._jumps, np.abs(values - last), out=self._jumps)

    def warnings(self) -> list[str]:
        """Return what makes the result doubtful, a sentence each."""
        return [*self._out_of_bounds(), *self._too_small(), *self._held()]

    def _check_bounds(self, values: Vector) -> None:
        excess = np.maximum(self._lower - values, values - self._upper)
        if not (excess > 0.0).any():
            return
        for place in np.flatnonzero(excess > 0.0):
            before = self._outside.get(int(place))
            value = float(values[place])
            if before is None or abs(value) > abs(before):
                self._outside[int(place)] = value

    def _out_of_bounds(self) -> list[str]:
        exchange = self._exchange
        return [
            f"{exchange.value_names[place]} came to {value:.6g}, outside of its declared bounds "
            f"[{exchange.lower[place]:.6g}, {exchange.upper[place]:.6g}] or those of an input that "
            "it drives: what an FMU answers to that need not be right."
            for place, value in self._outside.items()
        ]

    def _too_small(self) -> list[str]:
        if self._resolved is None:
            return []
        exchange, allowed = self._exchange, self._resolved * self._exchange.nominal
        small = (self._peaks > 0.0) & (self._peaks < seen * allowed) & exchange.continuous
        return [
            f"{exchange.value_names[place]} never exceeded {self._peaks[place]:.3g}, so that an "
            f"error of {allowed[place]:.3g} (the tolerance of {self._resolved:.3g} times its "
            f"nominal value of {exchange.nominal[place]:.3g}) says little: declare a nominal value "
            "of its magnitude, or take a smaller tolerance."
            for place in np.flatnonzero(small)
        ]

    def _held(self) -> list[str]:
        if self._controlled is None:
            return []
        warnings = []
        for place, stage in enumerate(self._exchange.stages):
            names = self._uncontrolled(stage)
            if stage.participant.input_shape == "linear" or not names:
                continue
            jump = self._largest_jump(place)
            if jump is not None:
                warnings.append(
                    f"{stage.participant.name} holds its inputs over every step, in which "
                    f"{jump} at most: the error which that leaves in {list_names(names)} is of "
                    "first order in the step, and the tolerance does not see it; compare with a "
                    "run with smaller steps (max_step)."
                )
        return warnings

    def _largest_jump(self, place: int) -> str | None:
        """Return which input of a participant changed most, over its nominal value, in a step."""
        exchange, controlled = self._exchange, self._controlled or 0.0
        relative = self._jumps / exchange.nominal * exchange.continuous
        wires = [wire for wire in exchange.wires if wire.target_stage == place]
        wire = max(wires, key=lambda item: float(relative[item.value]), default=None)
        if wire is None or not relative[wire.value] > controlled:
            return None
        return f"{exchange.value_names[wire.value]} changed by {self._jumps[wire.value]:.3g}"

    def _uncontrolled(self, stage: Stage) -> list[str]:
        """Return continuous outputs that drive nothing, so that no error control sees them."""
        participant = stage.participant
        driving = set(self._exchange.value_names)
        paths = {
            f"{participant.name}.{variable.name}"
            for variable in participant.variables.values()
            if (variable.causality, variable.type, variable.variability)
            == ("output", "Real", "continuous")
        }
        return sorted(paths - driving)
