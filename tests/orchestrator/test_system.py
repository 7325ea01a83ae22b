"""Wiring: what is refused, in which order participants step, and how initial values settle."""

from itertools import permutations

import numpy as np
import pytest
from fake_participants import Answering, Fake, Linear, Spring, oscillators

from orchestrator import (
    Connection,
    InitialisationError,
    Master,
    MasterSettings,
    Recorder,
    System,
    Variable,
    WiringError,
    ordering,
)
from orchestrator.block import tear
from orchestrator.exchange import Exchange
from orchestrator.ordering import coupled_blocks, order_of_fewest_torn


def wire(source, target):
    return Connection(source=source, target=target)


def answering(*names):
    return [Answering(name, lambda _t, _h: None) for name in names]


@pytest.mark.parametrize(
    ("connections", "message"),
    [
        ([wire("a", "b.u")], r"'a' is not of the form"),
        ([wire("c.y", "b.u")], r"no participant 'c'; known are 'a', 'b'\.$"),
        ([wire("a.z", "b.u")], r"a has no variable 'z'; known are 'u', 'y'\.$"),
        ([wire("a.u", "b.u")], r"a\.u is no output but input"),
        ([wire("a.y", "b.y")], r"b\.y is no input but output"),
        (
            [wire("a.y", "b.u"), wire("b.y", "b.u")],
            r"b\.u is driven by 2 connections, from a\.y and b\.y",
        ),
    ],
)
def test_connections_that_do_not_fit_are_refused(connections, message):
    with pytest.raises(WiringError, match=message):
        System(answering("a", "b"), connections)


def test_similar_names_are_offered():
    spring = Spring("wheel_spring", abs)
    with pytest.raises(WiringError, match=r"perhaps 'displacement' is meant\.$"):
        System([spring], [wire("wheel_spring.displacment", "wheel_spring.displacement")])


@pytest.mark.parametrize("name", ["", "a.b"])
def test_names_of_participants_are_checked(name):
    with pytest.raises(WiringError, match="no name for a participant"):
        System(answering(name), [])


def test_names_of_participants_are_unique():
    with pytest.raises(WiringError, match="2 participants are called 'a'"):
        System(answering("a", "a"), [])
    with pytest.raises(WiringError, match="at least one participant"):
        System([], [])


class Typed(Fake):
    inputs = ("u",)
    outputs = ("y",)

    def __init__(self, name, **details):
        self.details = details
        super().__init__(name)


def test_units_must_agree_where_both_are_given():
    metres = Typed("a", y={"unit": "m"})
    with pytest.raises(WiringError, match=r"a\.y -> b\.u: the units 'm' and 'mm' differ"):
        System([metres, Typed("b", u={"unit": "mm"})], [wire("a.y", "b.u")])
    System([metres, Typed("b")], [wire("a.y", "b.u")])


def test_only_real_values_are_coupled():
    with pytest.raises(WiringError, match=r"a\.y is of type Boolean, but only Real"):
        System([Typed("a", y={"type": "Boolean"}), Typed("b")], [wire("a.y", "b.u")])


def test_bounds_must_leave_a_value():
    system = System(
        [Typed("a", y={"minimum": 2.0}), Typed("b", u={"maximum": 1.0})], [wire("a.y", "b.u")]
    )
    with pytest.raises(WiringError, match=r"a\.y: the bounds .* minimum 2 exceeds .* maximum 1"):
        Master(system, MasterSettings(tolerance=1.0)).run(0.0, 1.0)


@pytest.mark.parametrize(
    ("details", "message"),
    [
        ({"nominal": 0.0}, "nominal 0.0 must be positive"),
        ({"nominal": float("inf")}, "nominal inf must be positive and finite"),
        ({"minimum": 1.0, "maximum": 0.0}, "minimum 1.0 must not exceed maximum 0.0"),
        ({"type": "Float64"}, "type 'Float64' is none of Real"),
    ],
)
def test_variables_are_checked(details, message):
    with pytest.raises(WiringError, match=message):
        Variable(name="x", **details)


class Vehicle(Fake):
    inputs = ("rail[1]", "rail[2]")
    outputs = ("position[1]", "position[2]", "force[1]", "force[2]")


class Track(Fake):
    inputs = ("position[1]", "position[2]", "force[1]", "force[2]")
    outputs = ("rail[1]", "rail[2]")


def test_the_fewest_values_are_torn():
    vehicle, track = Vehicle("vehicle"), Track("track")
    connections = [
        *(wire(f"vehicle.{name}", f"track.{name}") for name in Track.inputs),
        *(wire(f"track.{name}", f"vehicle.{name}") for name in Vehicle.inputs),
    ]
    for participants in ([vehicle, track], [track, vehicle]):
        system = System(participants, connections)
        exchange = Exchange(system, indicators=[], observed=[], input_shape="linear")
        (block,) = tear(exchange, everything=False, last=None)
        assert [participants[place].name for place in block.order] == ["vehicle", "track"]
        assert block.names == ("track.rail[1]", "track.rail[2]")
        (everything,) = tear(exchange, everything=True, last=None)
        assert everything.unknowns.size == 6


def test_an_output_that_drives_several_inputs_is_torn_once():
    links = [(0, "x", 1), (0, "x", 2), (1, "p", 0), (1, "q", 0), (2, "r", 0)]
    assert order_of_fewest_torn([0, 1, 2], links) == [1, 2, 0]


def torn(order, links):
    rank = {place: n for n, place in enumerate(order)}
    return len({(a, name) for a, name, b in links if rank[a] >= rank[b]})


def test_the_order_is_the_best_of_all():
    random = np.random.default_rng(3)
    for _ in range(20):
        links = [
            (a, f"{a}-{n}", int(b))
            for a in range(5)
            for n in range(3)
            for b in random.choice(5, random.integers(0, 3), replace=False)
        ]
        best = min(torn(order, links) for order in permutations(range(5)))
        assert torn(order_of_fewest_torn(range(5), links), links) == best


@pytest.mark.parametrize(
    ("links", "fewest"),
    [
        ([(n, "y", (n + 1) % 40) for n in range(40)], 1),
        ([((n + 1) % 40, "y", n) for n in range(40)], 1),
        ([(n, "y", m) for n in range(40) for m in (n - 1, n + 1) if 0 <= m < 40], 20),
        ([(n, f"y{i}", 20 * (n < 20) + i) for n in range(40) for i in range(20)], 400),
    ],
    ids=["ring", "ring the other way", "chain to and fro", "everyone across"],
)
def test_large_blocks_are_ordered_too(links, fewest):
    assert torn(order_of_fewest_torn(range(40), links), links) == fewest


def test_the_order_of_a_large_block_is_a_good_one(monkeypatch):
    """Within a tenth of the best on average, where the best can be found."""
    random = np.random.default_rng(7)
    best = good = 0
    for _ in range(20):
        links = [
            (a, f"{a}-{n}", int(b))
            for a in range(9)
            for n in range(2)
            for b in random.choice(9, random.integers(0, 3), replace=False)
        ]
        best += torn(order_of_fewest_torn(range(9), links), links)
        with monkeypatch.context() as patch:
            patch.setattr(ordering, "largest_exact_block", 0)
            good += torn(order_of_fewest_torn(range(9), links), links)
    assert best <= good <= 1.1 * best


def test_blocks_come_upstream_first():
    links = [(3, "y", 2), (2, "y", 3), (2, "z", 0), (0, "y", 1)]
    assert coupled_blocks(5, links) in ([[2, 3], [4], [0], [1]], [[4], [2, 3], [0], [1]])


def test_values_run_through_a_chain_within_one_step():
    source = Linear(
        "source", inputs=[], outputs=["y"], A=[[0]], B=np.zeros((1, 0)), C=[[1]],
        D=np.zeros((1, 0)), x0=[1.0], c=[2.0],
    )  # fmt: skip
    springs = [Spring(f"s{n}", lambda x: 2.0 * x) for n in range(3)]
    connections = [
        wire("s1.force", "s0.displacement"),
        wire("s2.force", "s1.displacement"),
        wire("source.y", "s2.displacement"),
    ]
    recorder = Recorder(["s0.force"])
    settings = MasterSettings(tolerance=None, fixed_step=0.5)
    outcome = Master(System([*springs, source], connections), settings, observers=[recorder]).run(
        0, 1
    )
    assert recorder["s0.force"].tolist() == [8.0, 16.0, 24.0]
    assert outcome.statistics.iterations == 2


class Initialised(Fake):
    """y = gain * u + offset, at all times."""

    inputs = ("u",)
    outputs = ("y",)

    def __init__(self, name, gain, offset):
        super().__init__(name)
        self.gain, self.offset = gain, offset

    def initial_outputs(self, values):
        return [self.gain * values[0] + self.offset]

    def advance(self, over):
        return [self.gain * over.end[0] + self.offset]


@pytest.mark.parametrize("gain", [0.0, 0.5, -3.0])
def test_initial_values_agree_on_both_ends(gain):
    a, b = Initialised("a", gain, 1.0), Initialised("b", 1.0, 0.0)
    recorder = Recorder()
    system = System([a, b], [wire("a.y", "b.u"), wire("b.y", "a.u")])
    Master(system, MasterSettings(tolerance=None, fixed_step=0.1), observers=[recorder]).run(0, 1)
    exact = 1.0 / (1.0 - gain)
    assert recorder.values[0] == pytest.approx([exact, exact], abs=1e-9)
    assert recorder.values[-1] == pytest.approx([exact, exact], abs=1e-6)


def test_initial_values_that_do_not_settle_are_an_error_in_words():
    class Flipping(Initialised):
        def initial_outputs(self, values):
            return [1.0 if values[0] <= 0.0 else -1.0]

    a, b = Flipping("a", 1.0, 0.0), Initialised("b", 1.0, 0.0)
    system = System([a, b], [wire("a.y", "b.u"), wire("b.y", "a.u")])
    with pytest.raises(InitialisationError, match=r"initial values do not settle: .*b\.y"):
        Master(system, MasterSettings(tolerance=1.0)).run(0.0, 1.0)


def test_the_life_of_a_participant_has_an_order():
    system = oscillators()
    Master(system, MasterSettings(tolerance=None, fixed_step=0.1)).run(0.0, 1.0)
    for participant in system.participants:
        assert participant.calls == ["instantiate", "enter", "exit", "terminate", "free"]
