"""How strongly a loop answers to its own values within one step: the limit of what is explicit."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .block import Block
from .decision import Failure
from .errors import LoopGainError, list_names
from .exchange import Exchange
from .participant import Matrix, Vector

increment = 1e-5
"""Change of a torn value for its finite difference, over its nominal value."""

refused_gain, doubtful_gain = 1.0, 0.5
"""From here on an explicit algorithm is refused, and above here warned of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopGain:
    """What a loop returns of a small change of its torn values at the end of one step.

    Attributes
    ----------
    names : tuple of str
        The torn values, as ``participant.variable``.
    jacobian : numpy.ndarray, shape (n, n), or None
        Change of what is computed over the change of what was prescribed, both over the nominal
        values; None when it could not be found.
    obstacle : str
        Why it could not be found, or ``""``.
    """

    names: tuple[str, ...]
    jacobian: Matrix | None
    obstacle: str = ""

    @property
    def gain(self) -> float:
        """Spectral radius of the Jacobian: what one pass through the loop multiplies."""
        return float("nan") if self.jacobian is None else spectral_radius(self.jacobian)

    @property
    def growth(self) -> float:
        """Spectral radius of z <- J (2 z - z_before): what a step multiplies that extrapolates.

        It counts what happens within a step, not what the participants remember of earlier ones.
        """
        if self.jacobian is None:
            return float("nan")
        zero, one = np.zeros_like(self.jacobian), np.eye(len(self.jacobian))
        return spectral_radius(np.block([[2.0 * self.jacobian, -self.jacobian], [one, zero]]))


def spectral_radius(matrix: Matrix) -> float:
    """Return the largest absolute eigenvalue."""
    return float(np.abs(np.linalg.eigvals(matrix)).max(initial=0.0))


def estimate_loop_gains(
    exchange: Exchange, blocks: Sequence[Block], time: float, step_size: float
) -> list[LoopGain]:
    """Step every coupled block from the present state with slightly different torn values.

    Participants, inputs and outputs are left as they were, bit for bit.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays, with the values at `time`.
    blocks : sequence of Block
        Upstream first.
    time, step_size : float
        The step [s].

    Returns
    -------
    list of LoopGain
        One per block with torn values.
    """
    return [_estimate(exchange, block, time, step_size) for block in blocks if block.unknowns.size]


def review_loop_gains(
    gains: Sequence[LoopGain], step_size: float, *, extrapolates: bool
) -> list[str]:
    """Return a warning for every loop in doubt.

    Parameters
    ----------
    gains : sequence of LoopGain
        From `estimate_loop_gains`.
    step_size : float
        The step that was made for them [s].
    extrapolates : bool
        Whether the explicit algorithm continues torn values on straight lines.

    Raises
    ------
    LoopGainError
        When the gain of a loop is 1 or more, or so large that extrapolated values run away.
    """
    warnings = []
    for item in gains:
        loop = f"the loop through {list_names(item.names)}"
        if item.jacobian is None:
            warnings.append(
                f"The gain of {loop} is unknown, because {item.obstacle}: compare with a run at "
                "half the step."
            )
            continue
        gain, remedy = item.gain, "use the algorithm newton, which solves the loop"
        found = f"{loop} has a gain of {gain:.3g} over a step of {step_size:.6g} s"
        if not gain < refused_gain:
            raise LoopGainError(
                f"An explicit algorithm cannot work, because {found}, and from a gain of 1 on "
                f"every step makes the error larger; {remedy}."
            )
        if extrapolates and not item.growth < refused_gain:
            raise LoopGainError(
                f"An explicit algorithm that extrapolates cannot work, because {found}, which "
                f"multiplies an error by {item.growth:.3g} with every step; {remedy}, or hold the "
                "values instead (extrapolate = False)."
            )
        if gain > doubtful_gain:
            warnings.append(
                f"An explicit algorithm is in doubt, because {found} (1 is the limit); {remedy}."
            )
    return warnings


def _estimate(exchange: Exchange, block: Block, time: float, step_size: float) -> LoopGain:
    sources = {wire.source_stage for wire in exchange.wires if wire.value in block.unknowns}
    stages = [exchange.stages[place] for place in sorted(sources | set(block.order))]
    unable = [item.participant.name for item in stages if not item.participant.can_save_state]
    if unable:
        obstacle = f"{' and '.join(unable)} cannot save the state it starts from"
        return LoopGain(names=block.names, jacobian=None, obstacle=obstacle)
    inputs, outputs = exchange.inputs.copy(), exchange.outputs.copy()
    for stage in stages:
        stage.save()
    try:
        jacobian = _difference(block, block.computed(), time, step_size)
    finally:
        for stage in stages:
            stage.go_back()
            stage.release()
        exchange.inputs[:], exchange.outputs[:] = inputs, outputs
    if isinstance(jacobian, Failure):
        return LoopGain(names=block.names, jacobian=None, obstacle=jacobian.message.rstrip("."))
    return LoopGain(names=block.names, jacobian=jacobian)


def _difference(block: Block, start: Vector, time: float, step_size: float) -> Matrix | Failure:
    failure = block.step(start, time, step_size)
    if failure is not None:
        return failure
    before = block.computed()
    jacobian = np.empty((start.size, start.size))
    for column, nominal in enumerate(block.nominal):
        change = increment * nominal
        if start[column] + change > block.upper[column]:
            change = -change
        nearby = start.copy()
        nearby[column] += change
        failure = block.step(nearby, time, step_size)
        if failure is not None:
            return failure
        # Over what was added after rounding, not what was meant to be added.
        moved = (nearby[column] - start[column]) / nominal
        jacobian[:, column] = (block.computed() - before) / block.nominal / moved
    return jacobian
