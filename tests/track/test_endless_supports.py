"""Supports that differ travel along the endless track, and the window moves over them unseen."""

from dataclasses import replace

import numpy as np
import pytest

from track_fmu.ballast import PolynomialBallast
from track_fmu.characteristics import LinearCharacteristic, PolynomialCharacteristic
from track_fmu.contact_track import ContactTrack
from track_fmu.pads import TotalPad
from track_fmu.preloaded_pad import PreloadedPad
from track_fmu.support_factors import SupportFactors
from track_fmu.total_ballast import TotalBallast
from track_fmu.track_model import TrackModel, TrackOptions
from track_fmu.viscoelastic_pads import ViscoelasticPads
from vehicle_fmu.hertz_contact import HertzContact
from vehicle_fmu.parameters import FlatParameters
from vehicle_fmu.surfaces import Surfaces

from .reference import STATIC_LOAD, Track

SPACING, MOVE, BASE = 0.65, 10, 1.8
STIFFNESS, DAMPING = 30e6, 31e3
MASS = 592.5  # kg
PEAK = 0.5e-3  # s behind the middle of a flat, about when it strikes
TABLE = PreloadedPad(
    np.array([20e3, 30e3, 40e3, 60e3, 80e3]),
    np.array([20e6, 26e6, 33e6, 50e6, 70e6]),
    3.0 * np.array([20e6, 26e6, 33e6, 50e6, 70e6]),
    0.03 * np.array([20e6, 26e6, 33e6, 50e6, 70e6]),
    clip_preload=20e3,
)


def factors(supports, *, gaps=()):
    """Random properties of so many supports, and gaps of 0.5 mm under some (from 0)."""
    random = np.random.default_rng(6)
    pads, beds = np.exp(random.normal(0.0, [[0.2], [0.4]], (2, supports)))
    gap = np.zeros(supports)
    gap[list(gaps)] = 5e-4
    nominal = SupportFactors.nominal(supports)
    return replace(
        nominal, pad_stiffness=pads, pad_damping=pads, ballast_stiffness=beds,
        ballast_damping=beds, gap=gap,
    )  # fmt: skip


def beds(own, *, pulls):
    return TotalBallast(
        characteristic=PolynomialCharacteristic(alpha=0.37e12, beta=-2.47e15, delta=5.75e18),
        linear_stiffness=STIFFNESS, linear_damping=DAMPING, factors=own, pulls=pulls,
        sleeper_weight=1226.0, rail_weight=383.0,
    )  # fmt: skip


def springs(own):
    return TotalPad(
        characteristic=LinearCharacteristic(),
        linear_stiffness=80e6, linear_damping=15e3, factors=own,
    )  # fmt: skip


def viscoelastic(own):
    return ViscoelasticPads(pad=TABLE, linear_stiffness=80e6, linear_damping=15e3, factors=own)


def laws(kind):
    """Ballast and pads over two hundred supports."""
    own = factors(200, gaps=(43, 44, 57) if kind == "hanging" else ())
    pads = viscoelastic(own) if kind == "viscoelastic" else springs(own)
    return {"ballast": beds(own, pulls=kind == "pulled"), "pad": pads}


def wheels(leading):
    return np.array([leading, leading - BASE])


class Bogie:
    """Two wheels of 592.5 kg under constant loads on the contacts of an endless track.

    The window is laid so that it moves one bay after the start, about 30 m from the first support.
    """

    START, AHEAD = 29.9, 4.5  # m, bays from the middle of the window, which moves at 5.5

    def __init__(self, track, speed, *, flat=None, supports=12, **law):
        options = TrackOptions(
            wheels=2, endless=True, initial_speed=speed, supports_per_wheel=supports
        )
        self.track = TrackModel(track.reduced, options, **law)
        shape = FlatParameters(
            shape="none" if flat is None else "haversine", length=0.1, depth=0.5e-3, wheel=1,
            position=flat or 0.0, periodic=False, rolled=False,
        )  # fmt: skip
        self.contact = ContactTrack(
            self.track,
            law=HertzContact(9.17e10),
            surface=Surfaces(shape, flat_table=None, irregularity=None, wheels=2, radius=0.45),
            static_load=STATIC_LOAD,
        )
        middle = self.START - 0.5 * BASE
        offset = round(middle / SPACING - self.AHEAD) - 25
        self.track.window.centre = lambda _: self.track._state.offset.fill(offset)
        self.speed, self.place = speed, self.START
        self.z, self.v = np.zeros(2), np.zeros(2)
        self.contact.start(wheels(self.place), self.z)

    @property
    def state(self):
        return self.contact.state, self.place, self.z.copy(), self.v.copy()

    @state.setter
    def state(self, saved):
        self.contact.state, self.place, z, v = saved
        self.z, self.v = z.copy(), v.copy()

    @property
    def window(self):
        return round(self.contact.observe().window_position[0] / SPACING)

    def step(self):
        """One step of 100 us of the velocity Verlet method; the contact forces at its end."""
        h, force = 1e-4, self.contact.contact_force
        self.place += self.speed * h
        self.z += h * (self.v + 0.5 * h * (STATIC_LOAD - force) / MASS)
        self.contact.step(h, wheels(self.place), self.z, linear=True)
        self.v += 0.5 * h * (2.0 * STATIC_LOAD - force - self.contact.contact_force) / MASS
        return self.contact.contact_force

    def to_the_seam(self):
        """Run until the next step moves the window."""
        first = self.window
        while self.window == first:
            before = self.state
            self.step()
        self.state = before

    def change(self, steps=10):
        """What the move changes in the forces of some steps, over the static load; and those."""
        saved, seen = self.state, []
        follow = self.track.window.follow
        for moves in (True, False):
            self.state = saved
            self.track.window.follow = follow if moves else lambda _: False
            seen.append((np.array([self.step() for _ in range(steps)]), self.window))
        self.track.window.follow = follow
        assert seen[0][1] - seen[1][1] == MOVE
        return np.abs(seen[0][0] - seen[1][0]).max() / STATIC_LOAD, seen[1][0]


def at_the_seam(track, speed, *, flat, **law):
    """A bogie right before the window moves, its leading wheel in the middle of its flat or not."""
    bogie = Bogie(track, speed, **law)
    bogie.to_the_seam()
    if flat:
        bogie = Bogie(track, speed, flat=bogie.place - PEAK * speed, **law)
        bogie.to_the_seam()
    return bogie


@pytest.fixture(scope="module")
def fine():
    """The track of Table 1 with 250 pairs: above 40 km/h strikes set higher modes in motion."""
    return Track(250)


@pytest.fixture(scope="module")
def beams():
    """Sleepers that bend, with nine pairs a bay, likewise."""
    return Track(450, sleeper="beam")


STRIKES = pytest.mark.parametrize("flat", [False, True], ids=["round", "strike"])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pulled", "loose", "hanging", "viscoelastic"])
def test_the_seam_is_invisible_in_a_strike_at_40_kmh(table1, kind):
    """In the step of the move and for a millisecond."""
    change, force = at_the_seam(table1, 40.0 / 3.6, flat=True, **laws(kind)).change()
    assert 0.0 < change < 1e-4
    assert force.max() > 1.2 * STATIC_LOAD


@STRIKES
@pytest.mark.parametrize("kind", ["pulled", "loose", "hanging", "viscoelastic"])
def test_the_seam_is_invisible_at_60_metres_a_second(fine, kind, flat):
    """Where the wheel takes off from the rail in the strike, or nearly."""
    change, force = at_the_seam(fine, 60.0, flat=flat, **laws(kind)).change()
    assert 0.0 < change < 1e-4
    assert force.max() > (1.7 if flat else 0.9) * STATIC_LOAD


@pytest.mark.slow
@STRIKES
@pytest.mark.parametrize("speed", [40.0 / 3.6, 60.0], ids=["40 km/h", "60 m/s"])
@pytest.mark.parametrize("differing", [False, True], ids=["alike", "differing"])
def test_the_seam_over_sleepers_that_bend_is_invisible(beams, differing, speed, flat):
    pad = springs(factors(200)) if differing else None
    bogie = at_the_seam(beams, speed, flat=flat, ballast=PolynomialBallast(), pad=pad)
    change, force = bogie.change()
    assert 0.0 < change < 1e-4
    assert force.max() > (1.2 if flat else 0.9) * STATIC_LOAD


@pytest.mark.slow
def test_sleepers_that_bend_are_moved_with_all_of_their_motion(beams):
    """Moments, pads and ballast before a move are those of the supports ten bays on after it."""
    bogie = at_the_seam(beams, 60.0, flat=True, ballast=PolynomialBallast())
    names = ("sleeper_displacement", "sleeper_moment", "sleeper_centre_moment", "ballast_force")
    before = {name: getattr(bogie.track.observe(), name).copy() for name in names}
    bogie.track.follow_wheels()
    for name in names:
        moved, largest = getattr(bogie.track.observe(), name), np.abs(before[name]).max()
        assert moved[:-MOVE] == pytest.approx(before[name][MOVE:], abs=2e-4 * largest)


def test_a_track_of_one_soft_support_feels_it_where_it_is(table1):
    """The deepest sleeper is the soft one when the wheel stands on it, wherever the window is."""
    soft = SupportFactors.nominal(60)
    soft.ballast_stiffness[55] = 0.3
    bogie = Bogie(table1, 60.0, supports=6, ballast=beds(soft, pulls=True))
    first, deepest = bogie.window, {}
    while bogie.place < 56 * SPACING + 2.0:
        bogie.step()
        seen = bogie.track.observe().sleeper_displacement
        number = bogie.window + int(np.argmax(seen)) + 1
        deepest[number] = max(deepest.get(number, 0.0), float(seen.max()))
    assert bogie.window == first + 2 * MOVE
    assert max(deepest, key=deepest.__getitem__) == 56
    assert deepest[56] > 1.25 * max(deepest[k] for k in deepest if k != 56)


def test_windows_are_nominal_before_the_first_support_and_beyond_the_last():
    own = factors(20)
    window = own.window(-5, 40)
    assert np.array_equal(window.pad_stiffness[5:25], own.pad_stiffness)
    assert (window.pad_stiffness[:5] == 1.0).all()
    assert (window.pad_stiffness[25:] == 1.0).all()
    assert (own.window(-60, 40).gap == 0.0).all()
    assert (own.window(10**9, 40).ballast_stiffness == 1.0).all()
    again = replace(own, repeat=True).window(-5, 50)
    assert np.array_equal(again.pad_stiffness[5:], np.resize(own.pad_stiffness, 45))
    assert (again.pad_stiffness[:5] == 1.0).all()


def test_a_step_over_the_seam_is_repeated_bit_for_bit(table1):
    bogie = at_the_seam(table1, 60.0, flat=False, **laws("viscoelastic"))
    saved, ends = bogie.state, []
    for steps in (3, 40, 3):
        bogie.state = saved
        for _ in range(steps):
            bogie.step()
        ends.append(bogie.contact.state)
    assert np.array_equal(ends[0], ends[2])
    assert not np.array_equal(ends[0], ends[1])
