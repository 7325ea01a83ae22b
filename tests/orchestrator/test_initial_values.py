"""Initial values: the order of their dependence, and loops of any number of participants."""

from types import MappingProxyType

import numpy as np
import pytest
from fake_participants import Fake, Linear, static, wire

from orchestrator import InitialisationError, Master, MasterSettings, System
from orchestrator import Linear as Conversion
from orchestrator.exchange import Exchange
from orchestrator.initial_graph import find_needs, group_values
from orchestrator.initialisation import settle_initial_values


class Counting(Linear):
    """Counts how often its outputs are read."""

    def get_outputs(self, out):
        self.reads = getattr(self, "reads", 0) + 1
        return super().get_outputs(out)


def lay_out(system):
    exchange = Exchange(system, indicators=[], observed=[], input_shape="linear")
    for participant in system.participants:
        participant.instantiate()
        participant.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
    return exchange


def settle(system):
    """Return the exchanged values by name, and the warnings."""
    exchange = lay_out(system)
    warnings = settle_initial_values(exchange)
    values = exchange.outputs[exchange.value_places].tolist()
    # Every input has what its source gives, but for the residual of torn ones.
    for item in exchange.wires:
        apart = exchange.inputs[item.input] - exchange.outputs[item.output]
        assert abs(apart) <= 1e-10 * exchange.nominal[item.value]
    return dict(zip(exchange.value_names, values, strict=True)), warnings


def structure(system):
    """Return the groups of values by name, each with its torn values."""
    exchange = lay_out(system)
    names = exchange.value_names
    return [
        ([names[value] for value in group.order], [names[value] for value in group.torn])
        for group in group_values(find_needs(exchange, ()))
    ]


def there_and_back(*, declares=True, gain=50.0):
    """a.p -> b.q -> a.r -> b.s: a circle of participants, but none of values."""
    a = static(
        "a", inputs=["in_p", "in_r"], outputs=["p", "r"], D=[[0, 0], [0, gain]], e=[2, 1],
        kind=Counting, declares=declares,
    )  # fmt: skip
    b = static(
        "b", inputs=["in_q", "in_s"], outputs=["q", "s"], D=[[gain, 0], [0, gain]], e=[1, 1],
        kind=Counting, declares=declares,
    )  # fmt: skip
    wires = [
        wire("a.p", "b.in_q"),
        wire("b.q", "a.in_r"),
        wire("a.r", "b.in_s"),
        wire("b.s", "a.in_p"),
    ]
    return System([a, b], wires)


exact_there_and_back = {"a.p": 2.0, "b.q": 101.0, "a.r": 5051.0, "b.s": 252551.0}


def test_a_circle_of_participants_that_is_none_of_values_is_computed_in_order():
    system = there_and_back()
    assert structure(system) == [(["a.p", "b.q", "a.r", "b.s"], [])]
    values, warnings = settle(system)
    assert values == exact_there_and_back
    assert warnings == []
    # The start value, two turns each, the check.
    assert [participant.reads for participant in system.participants] == [4, 4]


def test_the_same_participants_without_a_word_are_solved_as_a_loop():
    system = there_and_back(declares=False)
    ((_, torn),) = structure(system)
    assert len(torn) == 2
    values, _ = settle(system)
    assert values == pytest.approx(exact_there_and_back, rel=1e-12)


def test_declarations_that_leave_something_out_are_found_and_passed_over():
    system = there_and_back()
    liar = system.participants[0]
    liar.dependencies = dict.fromkeys(liar.outputs, frozenset())
    values, warnings = settle(system)
    assert values == pytest.approx(exact_there_and_back, rel=1e-12)
    (warning,) = warnings
    assert "a.r depends on more inputs than a declares" in warning


def test_the_master_hands_the_warning_on():
    system = there_and_back(gain=0.5)
    liar = system.participants[1]
    liar.dependencies = dict.fromkeys(liar.outputs, frozenset())
    settings = MasterSettings(tolerance=None, fixed_step=0.5)
    (warning,) = Master(system, settings).run(0.0, 1.0).warnings
    assert "than b declares" in warning


def test_a_participant_that_does_not_repeat_itself_is_refused():
    class Drifting(Linear):
        def initial_outputs(self, values):
            self.count = getattr(self, "count", 0) + 1
            return super().initial_outputs(values) + self.count

    source = static("source", inputs=[], outputs=["y"], D=np.zeros((1, 0)), kind=Drifting)
    sink = static("sink", inputs=["u"], outputs=[], D=np.zeros((0, 1)))
    with pytest.raises(InitialisationError, match=r"source\.y of source changed"):
        settle(System([source, sink], [wire("source.y", "sink.u")]))


def test_an_output_need_not_exist_before_its_inputs_do():
    class Inverse(Fake):
        inputs, outputs = ("u", "v"), ("plain", "inverse")

        def initial_outputs(self, values):
            return [values[1] + 1.0, 1.0 / values[0] if values[0] else np.nan]

    inverse = Inverse("inverse")
    inverse.dependencies = {"plain": frozenset(["v"]), "inverse": frozenset(["u"])}
    double = static("double", inputs=["u"], outputs=["y"], D=[[2.0]], declares=True)
    sink = static("sink", inputs=["u"], outputs=["y"], D=[[1.0]], e=[3.0], declares=True)
    wires = [
        wire("inverse.plain", "double.u"),
        wire("double.y", "inverse.u"),
        wire("inverse.inverse", "sink.u"),
    ]
    values, _ = settle(System([sink, double, inverse], wires))
    assert values == {"inverse.plain": 1.0, "double.y": 2.0, "inverse.inverse": 0.5}
    # It has its input before the first step, although nothing depends on it.
    assert sink.values.tolist() == [0.5]


def circle(gains, offsets, **options):
    """A loop through one participant per matrix, each driven by the one before it."""
    participants, wires = [], []
    for n, (gain, offset) in enumerate(zip(gains, offsets, strict=True)):
        size = len(offset)
        participants.append(
            static(
                f"p{n}", D=gain, e=offset, inputs=[f"u{i}" for i in range(size)],
                outputs=[f"y{i}" for i in range(size)], **options,
            )
        )  # fmt: skip
        wires += [wire(f"p{n}.y{i}", f"p{(n + 1) % len(gains)}.u{i}") for i in range(size)]
    return System(participants, wires)


def solve_circle(gains, offsets):
    """The outputs of the last participant, in closed form."""
    through, offset = np.eye(len(offsets[0])), np.zeros(len(offsets[0]))
    for gain, extra in zip(gains, offsets, strict=True):
        through, offset = gain @ through, gain @ offset + extra
    return np.linalg.solve(np.eye(len(offset)) - through, offset)


@pytest.mark.parametrize("strength", [0.3, 0.9, 1.05, 1.5, 4.5])
@pytest.mark.parametrize("derivatives", [None, np.copy])
@pytest.mark.parametrize("declares", [True, False])
def test_a_loop_through_three_participants_is_solved_whatever_its_gain(
    strength, derivatives, declares
):
    random = np.random.default_rng(5)
    gains = [random.normal(size=(2, 2)) for _ in range(3)]
    radius = np.abs(np.linalg.eigvals(gains[2] @ gains[1] @ gains[0])).max()
    gains = [gain * (strength / radius) ** (1.0 / 3.0) for gain in gains]
    offsets = [random.normal(size=2) for _ in range(3)]
    system = circle(gains, offsets, declares=declares, derivatives=derivatives)
    ((_, torn),) = structure(system)
    assert len(torn) == 2
    values, _ = settle(system)
    exact = solve_circle(gains, offsets)
    assert [values["p2.y0"], values["p2.y1"]] == pytest.approx(exact, rel=1e-8)


def test_directional_derivatives_save_the_finite_differences_of_a_loop():
    """The residual, one correction with the exact Jacobian; start value and check besides."""
    gains = [np.array([[1.0, 2.0], [0.5, -3.0]])] * 3
    offsets = [np.array([1.0, 2.0])] * 3
    counts = []
    for derivatives in (np.copy, None):
        system = circle(gains, offsets, derivatives=derivatives, kind=Counting)
        settle(system)
        counts.append(system.participants[0].reads)
    assert counts[0] == 4
    assert counts[1] >= 4 + 2


def two_loops():
    """x <-> y (gain 4), a chain of two, then a loop of u, v, w; the second loop needs the chain."""
    first = static("first", inputs=["y"], outputs=["x"], D=[[4.0]], e=[1.0])
    second = static("second", inputs=["x"], outputs=["y"], D=[[-1.0]], e=[1.0])
    chain = static(
        "chain", inputs=["a", "b"], outputs=["c", "d"], D=[[1, 0], [0, 3]], declares=True
    )
    third = static("third", inputs=["w", "d"], outputs=["u"], D=[[-2.0, 1.0]])
    fourth = static("fourth", inputs=["u"], outputs=["v"], D=[[1.5]])
    fifth = static("fifth", inputs=["v"], outputs=["w"], D=[[1.0]], e=[-1.0])
    wires = [
        wire("first.x", "second.x"),
        wire("second.y", "first.y"),
        wire("second.y", "chain.a"),
        wire("chain.c", "chain.b"),
        wire("chain.d", "third.d"),
        wire("third.u", "fourth.u"),
        wire("fourth.v", "fifth.v"),
        wire("fifth.w", "third.w"),
    ]
    return System([fifth, chain, second, third, first, fourth], wires)


def test_two_loops_and_a_chain_between_them_are_solved_one_after_another():
    groups = structure(two_loops())
    assert [len(torn) for _, torn in groups] == [1, 0, 1]
    assert [set(order) for order, _ in groups] == [
        {"first.x", "second.y"},
        {"chain.c", "chain.d"},
        {"third.u", "fourth.v", "fifth.w"},
    ]
    values, _ = settle(two_loops())
    # x = 4 y + 1, y = 1 - x: x = 1, y = 0; shifted by the chain; u = d - 2 (1.5 u - 1).
    assert values == pytest.approx(
        {
            "first.x": 1.0, "second.y": 0.0, "chain.c": 0.0, "chain.d": 0.0,
            "third.u": 0.5, "fourth.v": 0.75, "fifth.w": -0.25,
        },
        abs=1e-9,
    )  # fmt: skip


def test_scales_and_units_do_not_matter():
    """Metres against newtons, with millimetres on the way back: nominals ten decades apart."""
    spring = static(
        "spring", inputs=["give"], outputs=["force"], D=[[-3e9]], e=[1e5], declares=True,
        details={"force": {"nominal": 1e5}},
    )  # fmt: skip
    support = static(
        "support", inputs=["force"], outputs=["give"], D=[[1e-6]], declares=True,
        details={"give": {"nominal": 1e-2}},
    )  # fmt: skip
    wires = [
        wire("spring.force", "support.force"),
        wire("support.give", "spring.give", Conversion(factor=1e-3)),
    ]
    values, _ = settle(System([spring, support], wires))
    # F = 1e5 - 3e9 * 1e-3 * 1e-6 F
    assert values["spring.force"] == pytest.approx(1e5 / 4.0, rel=1e-9)


def test_bounds_hold_at_a_solution_on_them():
    """Two springs on one support; one is lifted off and gives exactly its smallest force, zero."""

    class Pair(Fake):
        inputs, outputs = ("give[1]", "give[2]"), ("force[1]", "force[2]")
        details = MappingProxyType({"force[1]": {"minimum": 0.0}, "force[2]": {"minimum": 0.0}})

        def initial_outputs(self, values):
            return [max(4.0 * (w - u), 0.0) for w, u in zip((1.0, 0.1), values, strict=True)]

    seen = []

    class Support(Linear):
        def set_inputs(self, values):
            seen.append(values.min())
            return super().set_inputs(values)

    names = [("force[1]", "give[1]"), ("force[2]", "give[2]")]
    support = static(
        "support", inputs=[force for force, _ in names], outputs=[give for _, give in names],
        D=[[1.0, 0.5], [0.5, 1.0]], kind=Support,
    )  # fmt: skip
    wires = [wire(f"pair.{force}", f"support.{force}") for force, _ in names]
    wires += [wire(f"support.{give}", f"pair.{give}") for _, give in names]
    values, _ = settle(System([support, Pair("pair")], wires))
    # f1 = 4 (1 - f1) = 0.8, and at the other one 0.1 - 0.4 < 0: no force.
    assert [values["pair.force[1]"], values["pair.force[2]"]] == pytest.approx([0.8, 0.0], abs=1e-9)
    assert min(seen) >= 0.0


def test_who_only_follows_a_wrong_declaration_is_not_blamed():
    """a is asked twice, the second time with what b should have said the first time."""
    a = static(
        "a", inputs=["b", "c"], outputs=["p", "q"], D=[[1, 0], [1, 1]], e=[1, 0], declares=True
    )
    b = static("b", inputs=["p"], outputs=["y", "z"], D=[[0.5], [3]], e=[1, 0])
    b.dependencies = {"y": frozenset(), "z": frozenset(["p"])}
    sink = static("sink", inputs=["u"], outputs=[], D=np.zeros((0, 1)))
    wires = [wire("b.y", "a.b"), wire("a.p", "b.p"), wire("b.z", "a.c"), wire("a.q", "sink.u")]
    values, warnings = settle(System([a, b, sink], wires))
    # y = 1 + p/2, p = 1 + y
    assert values == pytest.approx({"b.y": 3.0, "a.p": 4.0, "b.z": 12.0, "a.q": 15.0}, abs=1e-9)
    (warning,) = warnings
    assert "b.y depends on more inputs than b declares" in warning


def test_wrong_declarations_that_lead_to_no_value_at_all_are_passed_over():
    class Inverse(Fake):
        inputs, outputs = ("u",), ("y",)

        def initial_outputs(self, values):
            return [1.0 / values[0] if values[0] else np.nan]

    inverse = Inverse("inverse")
    inverse.dependencies = {"y": frozenset()}
    two = static("two", inputs=[], outputs=["y"], D=np.zeros((1, 0)), e=[2.0], declares=True)
    double = static("double", inputs=["u"], outputs=["y"], D=[[2.0]], declares=True)
    sink = static("sink", inputs=["u"], outputs=[], D=np.zeros((0, 1)))
    wires = [wire("two.y", "double.u"), wire("double.y", "inverse.u"), wire("inverse.y", "sink.u")]
    values, _ = settle(System([inverse, two, double, sink], wires))
    assert values == {"two.y": 2.0, "double.y": 4.0, "inverse.y": 0.25}
