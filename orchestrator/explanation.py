"""Why an attempt was rejected, as a clause for an error message."""

import numpy as np

from .decision import Candidate, Cause
from .errors import list_inputs
from .exchange import Exchange
from .participant import Vector


def explain(candidate: Candidate, cause: Cause, exchange: Exchange, errors: Vector) -> str:
    """Return what was wrong with an attempt, naming the participant or value, and the inputs.

    Parameters
    ----------
    candidate : Candidate
        The attempt.
    cause : Cause
        Why it was rejected.
    exchange : Exchange
        The flat arrays, as the attempt left them.
    errors : numpy.ndarray, shape (n_values,)
        Difference of prediction and result of every exchanged value over the tolerance.
    """
    if candidate.failure is not None:
        message = candidate.failure.message
        if candidate.failure.cause is not Cause.CONVERGENCE:
            return message
    elif cause is Cause.ERROR and errors.size:
        worst = int(np.argmax(errors))
        message = (
            f"the predicted and the computed value of {exchange.value_names[worst]} differ by "
            f"{errors[worst]:.3g} times the tolerance (if it jumps there, give an indicator of the "
            "jump as an event)"
        )
    else:
        message = f"the controller rejected it because of {cause.name.lower()}"
    return f"{message}, with {list_inputs(exchange.list_inputs())}."
