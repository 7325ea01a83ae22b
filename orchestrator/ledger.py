"""What a connection of forces and motions adds to the energy of a system by itself."""

from collections.abc import Sequence

from .bond import Bond
from .bond_report import BondReport
from .errors import WiringError
from .exchange import Exchange, Wire

tolerated = 1e-2
"""Energy that a bond may make or lose, over the work exchanged, before there is a warning."""


class Ledger:
    """Adds up what both sides of every bond see.

    One side gets a force over the step, held or on a straight line, and moves; the other gets that
    motion and answers with a force. The two products differ, which drives the system or brakes it:
    the residual energy of Sadjina, Kyllingstad, Skjong & Pedersen, Energy conservation and power
    bonds in co-simulations, Engineering with Computers 33 (2017). What a participant puts out is
    taken as a parabola through the last three accepted points, so that what is added up is in
    error by a higher order than itself.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    bonds : sequence of Bond
        What carries power.

    Raises
    ------
    WiringError
        When the connections of a bond are not there.
    """

    def __init__(self, exchange: Exchange, bonds: Sequence[Bond]) -> None:
        self._accounts = [_Account(exchange, bond) for bond in bonds]

    def start(self) -> None:
        """Take the initial values."""
        for account in self._accounts:
            account.start()

    def accept(self, step_size: float, *, switched: bool) -> None:
        """Add the accepted step of `step_size` [s]; after a switch a new course begins."""
        for account in self._accounts:
            account.accept(step_size)
            if switched:
                account.forget()

    def reports(self) -> tuple[BondReport, ...]:
        """Return what every bond made or lost so far."""
        return tuple(account.report() for account in self._accounts)

    def warnings(self) -> list[str]:
        """Return a sentence for every bond that makes or loses too much."""
        return [
            f"The connections of {item.force} and {item.motion} made or lost {item.largest:.3g}, "
            f"which is {item.relative:.3g} of the work exchanged: take smaller steps."
            for item in self.reports()
            if item.relative > tolerated
        ]


class _Account:
    """One bond."""

    def __init__(self, exchange: Exchange, bond: Bond) -> None:
        self._bond = bond
        self._inputs, self._outputs = exchange.inputs, exchange.outputs
        force, motion = _wires(exchange, bond)
        self._force, self._motion = force, motion
        # The force drives the participant that puts out the motion, and the other way round.
        self._force_is_line = (
            exchange.stages[force.target_stage].participant.input_shape == "linear"
        )
        self._motion_is_line = (
            exchange.stages[motion.target_stage].participant.input_shape == "linear"
        )
        self._residual = self._largest = self._exchanged = 0.0
        self._before = self._last = (0.0, 0.0, 0.0, 0.0)
        self._behind = 0.0

    def start(self) -> None:
        self._last = self._read()
        self._behind = 0.0

    def forget(self) -> None:
        self._behind = 0.0

    def accept(self, size: float) -> None:
        force, motion, force_in, motion_in = now = self._read()
        force0, motion0, force_in0, motion_in0 = self._last
        force_bend = motion_bend = 0.0
        if self._behind:
            before = self._before
            ratio = size / self._behind
            force_bend = _bend(before[0], force0, force, ratio)
            motion_bend = _bend(before[1], motion0, motion, ratio)
        if not self._force_is_line:
            force_in0 = force_in
        mean_in, rise_in = 0.5 * (force_in0 + force_in), force_in - force_in0
        mean_force = 0.5 * (force0 + force) - force_bend / 12.0
        if self._bond.kind == "displacement":
            moved = mean_in * (motion - motion0) + rise_in * motion_bend / 12.0
            answered = mean_force * (motion_in - motion_in0)
        else:
            rise = motion - motion0
            moved = size * (
                mean_in * (0.5 * (motion0 + motion) - motion_bend / 12.0) + rise_in * rise / 12.0
            )
            if not self._motion_is_line:
                motion_in0 = motion_in
            answered = size * (
                mean_force * 0.5 * (motion_in0 + motion_in)
                + (force - force0) * (motion_in - motion_in0) / 12.0
            )
        self._residual += moved - answered
        self._largest = max(self._largest, abs(self._residual))
        self._exchanged += abs(moved)
        self._before, self._last, self._behind = self._last, now, size

    def report(self) -> BondReport:
        return BondReport(
            force=self._bond.force,
            motion=self._bond.motion,
            residual=self._residual,
            largest=self._largest,
            exchanged=self._exchanged,
        )

    def _read(self) -> tuple[float, float, float, float]:
        force, motion = self._force, self._motion
        return (
            float(self._outputs[force.output]),
            float(self._outputs[motion.output]),
            float(self._inputs[force.input]),
            float(self._inputs[motion.input]),
        )


def _bend(before: float, last: float, now: float, ratio: float) -> float:
    """Return the second derivative through three points, times the square of the last step.

    `ratio` is that of the last step to the one before it.
    """
    return 2.0 * ((now - last) - (last - before) * ratio) * ratio / (1.0 + ratio)


def _wires(exchange: Exchange, bond: Bond) -> tuple[Wire, Wire]:
    """Return the wires of force and motion between the two participants."""
    names = exchange.value_names
    for force in exchange.wires:
        for motion in exchange.wires:
            if (
                names[force.value] == bond.force
                and names[motion.value] == bond.motion
                and force.target_stage == motion.source_stage
                and motion.target_stage == force.source_stage
            ):
                return force, motion
    raise WiringError(
        f"{bond.force} and {bond.motion} are no bond: each has to drive the participant of the "
        "other one."
    )
