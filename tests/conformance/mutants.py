"""A pytest plugin that breaks the master on purpose: `-p tests.conformance.mutants --mutant NAME`.

Each mutant is a mistake that a master could contain and still look healthy. A test of the suite has
to notice it.
"""

from functools import wraps

import pytest

from orchestrator import ErrorControl, FixedStep, FmuParticipant, rollback
from orchestrator.decision import Cause
from orchestrator.events import Switches
from orchestrator.newton import NewtonCoupling
from orchestrator.prediction import History
from orchestrator.quasi_newton import FixedPoint
from orchestrator.rejection import Rejection
from orchestrator.stage import Stage


def after(patch, owner, name, change):
    """Let `change(self)` follow every call of a method."""
    plain = getattr(owner, name)

    @wraps(plain)
    def changed(self, *arguments, **options):
        result = plain(self, *arguments, **options)
        change(self)
        return result

    patch.setattr(owner, name, changed)


def restores_nothing(patch):
    """A step is repeated from where the last attempt ended."""
    after(patch, Stage, "__init__", lambda stage: setattr(stage, "_restore", lambda _state: None))


def restores_only_by_itself(patch):
    """A stage that has moved does not go back before its next step."""
    after(patch, Stage, "step", lambda stage: setattr(stage, "_moved", False))


def releases_too_early(patch):
    """A saved state is given up while it may still be needed."""
    after(patch, Stage, "save", lambda stage: stage.participant.release(stage._state))


def releases_never(patch):
    """Saved states are never given up."""

    def save(stage):
        stage._state = stage.participant.save()
        stage._moved = False

    patch.setattr(Stage, "save", save)


def keeps_history_at_switches(patch):
    """The straight line through the points before a switch is continued behind it."""

    def restart(history, values):
        history._last = values

    patch.setattr(History, "restart", restart)


def transposes_the_jacobian(patch):
    """What output i does to residual j is taken for what output j does to residual i."""
    plain = FixedPoint._difference

    def transposed(*arguments):
        inverse, failure = plain(*arguments)
        return (None if inverse is None else inverse.T.copy()), failure

    patch.setattr(FixedPoint, "_difference", transposed)


def learns_from_rejected_attempts(patch):
    """What an attempt learned is kept although the attempt was thrown away."""
    after(patch, NewtonCoupling, "attempt", NewtonCoupling.commit)


def ignores_the_event_tolerance(patch):
    """A switch counts as located when it is a thousandth away."""
    after(patch, Switches, "__init__", lambda switches: setattr(switches, "_tolerance", 1e-3))


def takes_discard_for_success(patch):
    """A step that was refused counts as taken."""
    plain = Stage._failure

    def failure(*arguments):
        found = plain(*arguments)
        return None if found.cause is Cause.DISCARD else found

    patch.setattr(Stage, "_failure", failure)


def takes_nan_for_a_value(patch):
    """Values that are not finite pass."""
    plain = Stage._failure

    def failure(stage, status, *arguments):
        found = plain(stage, status, *arguments)
        return None if "not finite" in found.message else found

    patch.setattr(Stage, "_failure", failure)


def ignores_min_step(patch):
    """Steps become as small as they like."""
    for controller in (FixedStep, ErrorControl):
        after(patch, controller, "__init__", lambda control: setattr(control, "min_step", 1e-300))


def forgives_every_error(patch):
    """Not one error in a row is forgiven, but any number."""
    after(patch, Rejection, "reject", lambda ours: setattr(ours, "_error_forgiven", False))


def believes_every_claim(patch):
    """The start-up check compares nothing."""
    patch.setattr(rollback.np, "flatnonzero", lambda _values: rollback.np.empty(0))


def holds_all_inputs(patch):
    """Inputs jump to their values instead of running there on straight lines."""
    plain = FmuParticipant.bind

    def bind(participant, **options):
        plain(participant, **{**options, "input_shape": "held"})

    patch.setattr(FmuParticipant, "bind", bind)


mutants = {
    mutant.__name__: mutant
    for mutant in (
        restores_nothing,
        restores_only_by_itself,
        releases_too_early,
        releases_never,
        keeps_history_at_switches,
        transposes_the_jacobian,
        learns_from_rejected_attempts,
        ignores_the_event_tolerance,
        takes_discard_for_success,
        takes_nan_for_a_value,
        ignores_min_step,
        forgives_every_error,
        believes_every_claim,
        holds_all_inputs,
    )
}


def pytest_addoption(parser):
    """Add the option that chooses the mutant."""
    parser.addoption("--mutant", choices=mutants)


def pytest_configure(config):
    """Break what is to be broken."""
    name = config.getoption("--mutant")
    if name is not None:
        mutants[name](pytest.MonkeyPatch())
