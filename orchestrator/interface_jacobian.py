"""A first guess of a loop's Jacobian from the directional derivatives of its participants."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from .exchange import Exchange, Wire
from .participant import Matrix, Participant
from .quasi_newton import invert
from .stage import Indices

Declared = Callable[[Participant], Mapping[str, frozenset[str] | None]]
"""Which dependences of a participant count, those of steps or those of the initialisation."""


class Link(NamedTuple):
    """A participant's turn in the way through a loop.

    Attributes
    ----------
    stage : int
        Place of the participant.
    wires : sequence of Wire
        Connections whose inputs are set just before, to what has been computed.
    outputs : numpy.ndarray of int
        Places in `Exchange.outputs` of what counts as computed then.
    """

    stage: int
    wires: Sequence[Wire]
    outputs: Indices


class InterfaceJacobian:
    """The chain rule along the way from the torn values through the participants and back.

    Directional derivatives hold at one point of time, for states that do not move. Over a step,
    states move too, so that this is the Jacobian of an infinitely short one.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    unknowns : numpy.ndarray of int, shape (n,)
        Places of the torn values among the exchanged values.
    torn : sequence of Wire
        Connections whose inputs take torn values.
    chain : sequence of Link
        The participants in their turns.
    declared : callable
        Dependences that count.
    """

    def __init__(
        self,
        exchange: Exchange,
        *,
        unknowns: Indices,
        torn: Sequence[Wire],
        chain: Sequence[Link],
        declared: Declared,
    ) -> None:
        self._exchange = exchange
        self._unknowns = unknowns
        self._torn = torn
        self._chain = chain
        self._declared = declared
        self._first_input, self._first_output = (
            np.cumsum([0, *sizes])
            for sizes in (
                [stage.inputs.size for stage in exchange.stages],
                [stage.outputs.size for stage in exchange.stages],
            )
        )

    @property
    def available(self) -> bool:
        """Whether all participants give derivatives, but for those that pass nothing on."""
        stages = [self._exchange.stages[place] for place in {link.stage for link in self._chain}]
        able = [stage.participant.provides_directional_derivatives for stage in stages]
        return any(able) and all(
            gives or not stage.passes_on(self._declared(stage.participant))
            for gives, stage in zip(able, stages, strict=True)
        )

    def inverse(self) -> Matrix | None:
        """Return the inverse Jacobian of (G(z) - z) / nominal in z / nominal, at the present point.

        Returns
        -------
        numpy.ndarray, shape (n, n), or None
            None when a participant gives no derivatives, or none that are of use.
        """
        exchange, count = self._exchange, self._unknowns.size
        derivatives: dict[int, Matrix] = {}
        for place in {link.stage for link in self._chain}:
            stage = exchange.stages[place]
            found = stage.directional_derivatives(self._declared(stage.participant))
            if found is None or not np.isfinite(found).all():
                return None
            derivatives[place] = found
        inputs = np.zeros((exchange.inputs.size, count))
        outputs = np.zeros((exchange.outputs.size, count))
        for wire in self._torn:
            inputs[wire.input, np.searchsorted(self._unknowns, wire.value)] = 1.0
        for link in self._chain:
            for wire in link.wires:
                inputs[wire.input] = outputs[wire.output]
            begin, end = self._first_input[link.stage : link.stage + 2]
            rows = derivatives[link.stage][link.outputs - self._first_output[link.stage]]
            outputs[link.outputs] = rows @ inputs[begin:end]
        nominal = exchange.nominal[self._unknowns]
        gains = outputs[exchange.value_places[self._unknowns]] * nominal / nominal[:, None]
        return invert(gains - np.eye(count))
