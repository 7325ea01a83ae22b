"""Laws of ballast and pads, and supports that differ: native and numpy track agree."""

from pathlib import Path

import numpy as np
import pytest

from .library import NativeError
from .twins import assert_alike, scaled

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
STATIC_LOAD = 117_720.0
SPEED = 40.0 / 3.6
BALLAST, PAD = (str(EXAMPLES / name) for name in ("ballast.csv", "pad.csv"))


def supports(**values):
    """Parameters of supports, `_6` at the end of a name for the sixth."""
    parts = {name: name.rpartition("_") for name in values}
    return {
        f"support[{number}].{name}": values[whole] for whole, (name, _, number) in parts.items()
    }


LAWS = {
    "tangent damping": {"ballast_tangent_damping": True},
    "no pull": {"ballast_pulls": False},
    "hyperbolic": {"ballast": "hyperbolic"},
    "hyperbolic without pull": {"ballast": "hyperbolic", "ballast_pulls": False},
    "table": {"ballast": BALLAST},
    "table with tangent damping": {"ballast": BALLAST, "ballast_tangent_damping": True},
    "viscoelastic pads": {"pad": PAD},
    "viscoelastic pads on a table": {"pad": PAD, "ballast": BALLAST},
    "pads after a table": {"pad": BALLAST, "ballast": "linear"},
    "gaps": supports(gap_5=0.4e-3, gap_6=1e-3, gap_7=0.1e-3),
    "a missing pad": supports(pad_stiffness_factor_6=0.0, pad_damping_factor_6=0.0),
    "missing fastenings": supports(fastened_4=False, fastened_6=False, fastened_7=False),
    "viscoelastic pads, one without fastening": {
        "pad": PAD,
        **supports(fastened_6=False, pad_stiffness_factor_5=0.5, pad_damping_factor_4=0.0),
    },
    "soft and stiff beds": supports(
        ballast_stiffness_factor_5=0.4, ballast_stiffness_factor_6=2.0, ballast_damping_factor_7=3.0
    ),
    "constant mass": {"ballast_mass": 200.0},
    "mass on linear ballast": {"ballast_mass": 80.0, "ballast": "linear"},
    "growing mass": {"ballast_mass": 60.0, "ballast_mass_grows": True},
    "heavy and light sleepers that lift off": {
        "ballast_pulls": False,
        **supports(sleeper_mass_factor_5=3.0, sleeper_mass_factor_7=0.3, gap_6=0.2e-3),
        **supports(ballast_stiffness_factor_8=5.0, pad_stiffness_factor_9=0.0),
    },
    "growing mass of a table without pull": {
        "ballast": BALLAST,
        "ballast_pulls": False,
        "ballast_mass": 60.0,
        "ballast_mass_grows": True,
    },
    "constant mass over gaps": {"ballast_mass": 100.0} | supports(gap_5=0.4e-3, gap_6=0.1e-3),
    "light and heavy sleepers": supports(sleeper_mass_factor_5=0.4, sleeper_mass_factor_6=3.0),
    "a heavy sleeper on viscoelastic pads": {"pad": PAD, **supports(sleeper_mass_factor_5=1.7)},
}
"""Parameters by which a track differs from the paper's."""


def drive(pair, *, random, step, positions, forces):
    """Steps under forces at random, all of which are compared."""
    for _ in range(6):
        positions = positions + SPEED * step
        pair.step(step, positions, forces * random.uniform(0.0, 2.0, 2))
        assert_alike(scaled(pair.states(), step), relative=3e-12)
    assert_alike(pair.outputs(), relative=3e-12)
    return positions


@pytest.mark.parametrize("values", LAWS.values(), ids=LAWS)
def test_start_and_steps(track_pair, short_track, values):
    pair = track_pair(short_track, speed=SPEED, values=values)
    positions, forces = np.array([4.5, 2.7]), np.array([1.3, 0.8]) * STATIC_LOAD
    pair.start(positions, forces)
    assert_alike(pair.outputs(), relative=3e-12)
    random = np.random.default_rng(5)
    for step in (2e-5, 1e-4, 4e-4):
        positions = drive(pair, random=random, step=step, positions=positions, forces=forces)


@pytest.mark.parametrize("values", LAWS.values(), ids=LAWS)
def test_steps_with_contacts(contact_pair, short_track, values):
    pair = contact_pair(short_track, values=values | {"flat.shape": "none"})
    positions, still = np.array([4.5, 2.7]), np.zeros(2)
    pair.start(positions, still)
    random = np.random.default_rng(5)
    for step in (2e-5, 1e-4, 2e-4):
        for _ in range(4):
            positions = positions + SPEED * step
            pair.step(step, positions, random.uniform(-2e-4, 3e-4, 2), linear=True)
    assert_alike(pair.outputs(), relative=1e-11)


@pytest.mark.parametrize(
    "values",
    [
        {"pad": PAD, "ballast": "hyperbolic"},
        {"ballast_mass": 100.0},
        supports(sleeper_mass_factor_7=0.5, sleeper_mass_factor_10=3.0),
    ],
    ids=["pads", "mass", "sleepers"],
)
def test_laws_travel_with_the_window_of_an_endless_track(track_pair, short_track, values):
    pair = track_pair(short_track, endless=True, speed=SPEED, values=values)
    positions, forces = np.array([4.8, 3.0]), np.full(2, STATIC_LOAD)
    pair.start(positions, forces)
    for _ in range(60):
        positions = positions + 0.04
        pair.step(2e-4, positions, forces)
    assert pair.numpy.observe().window_position[0] > 1.0
    # every move of the window projects the state anew, in other sums of its own
    assert_alike(scaled(pair.states(), 2e-4), relative=1e-9)


@pytest.mark.parametrize(
    "name", ["viscoelastic pads, one without fastening", "gaps", "constant mass over gaps"]
)
def test_states_are_restored_bit_for_bit_and_travel(native, name):
    def go(track, count):
        for _ in range(count):
            track.step(track.time, 1e-4)

    track = native("track", linear_inputs=True)
    for key, value in LAWS[name].items():
        track.set_one(key, value)
    track.enter()
    track.exit()
    track.set_group("wheel[#].contact_force", np.array([2.0, 0.5]) * STATIC_LOAD)
    go(track, 5)
    saved = track.state
    data = track.serialise(saved)
    go(track, 5)
    end = track.state.tobytes()
    track.set_group("wheel[#].contact_force", np.array([0.1, 1.5]) * STATIC_LOAD)
    go(track, 3)
    track.state = track.deserialise(data)
    go(track, 5)
    assert track.state.tobytes() == end


@pytest.mark.parametrize(
    "name",
    ["no pull", "gaps", "viscoelastic pads", "table", "growing mass", "light and heavy sleepers"],
)
def test_derivatives_are_those_of_differences(native, name):
    def moved(by):
        track.state = before
        track.set_group("wheel[#].contact_force", forces + np.array([by, 0.0]))
        track.step(track.time, 1e-4)
        return track.group("wheel[#].rail_displacement")

    track = native("track", linear_inputs=True)
    for key, value in LAWS[name].items():
        track.set_one(key, value)
    track.enter()
    track.exit()
    before, forces = track.state, np.array([1.2, 0.9]) * STATIC_LOAD
    expected = (moved(10.0) - moved(-10.0)) / 20.0
    moved(0.0)
    unknowns = ["wheel[1].rail_displacement", "wheel[2].rail_displacement"]
    found = track.derivative(unknowns, ["wheel[1].contact_force"], [1.0])
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"ballast": "hyperbolic", "ballast_slope": 0.0}, "slope = 0 1/m must be"),
        ({"ballast": "missing.csv"}, "missing.csv: cannot be read"),
        ({"pad": "rubber"}, "pad is 'rubber'; it must be"),
        ({"pad": PAD, "clip_preload": -1.0}, "clip_preload = -1 N must be"),
        ({"ballast": PAD}, "must be two finite numbers"),
        (supports(gap_3=-1e-3), "gap = -0.001 of support 3 must be a finite number"),
        (supports(pad_damping_factor_2=np.nan), "pad_damping_factor = nan of support 2"),
        (supports(sleeper_mass_factor_3=0.05), "0.05 of support 3 must be .* at least 0.1"),
        (
            supports(gap_3=1e-3, fastened_3=False),
            "support 3 is held by nothing: there is a gap of 0.001 m under it and the rail is not",
        ),
        (
            supports(ballast_stiffness_factor_4=0.0, pad_stiffness_factor_4=0.0),
            "support 4 is held by nothing: there is no ballast under it and no pad ties it",
        ),
        ({"ballast_mass": -1.0}, "mass = -1 kg must be"),
        ({"ballast_beta": -1e17}, "all loads on ballast and pads rise"),
    ],
)
def test_what_no_track_has_is_refused(native, values, message):
    track = native("track")
    for name, value in values.items():
        track.set_one(name, value)

    def initialise():
        track.enter()
        track.exit()

    with pytest.raises(NativeError, match=message):
        initialise()
