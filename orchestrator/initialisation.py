"""Initial values that agree on both ends of every connection."""

import numpy as np

from .block import Block, tear
from .decision import Failure
from .errors import InitialisationError
from .exchange import Exchange
from .newton import fixed_point
from .participant import Vector

settled = 1e-10
"""Residual over the nominal value at which initial values agree."""

max_iterations = 100


def settle_initial_values(exchange: Exchange) -> None:
    """Pass values through all participants, in initialisation mode, until nothing changes.

    The first guess is what the participants start with, the next ones simply hand values on: a
    chain of dependences that only looks like a loop settles so. A true loop is solved like the
    coupling of a step.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.

    Raises
    ------
    InitialisationError
        When a loop does not settle or a participant refuses.
    """
    for stage in exchange.stages:
        stage.read_outputs()
    for block in tear(exchange, everything=False, last=None):
        start = block.computed()
        if not start.size:
            failure = block.exchange(start)
        else:

            def evaluate(values: Vector, block: Block = block) -> Failure | None:
                return block.exchange(values)

            equations = fixed_point(block, settled, max_iterations)
            hand_on = -np.eye(start.size)
            failure = equations.solve(evaluate, block.computed, start, hand_on).failure
        if failure is not None:
            reason = failure.message.rstrip(".")
            raise InitialisationError(f"The initial values do not settle: {reason}.")
