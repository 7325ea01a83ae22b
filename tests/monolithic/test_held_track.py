"""How much of an endless track is held, and that where it lies does not matter."""

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.monolithic import solve
from railcosim.monolithic.held_track import held_track
from railcosim.monolithic.support_properties import properties_of
from railcosim.scenario_file import read_scenario

SPACING = 0.65
SHORT = ("run.approach=0.06", "run.departure=0.02", "vehicle.speed_kmh=60")
ENDLESS = ("track.endless=true", "track.bays=6", "flat.position=103.6", *SHORT)


def test_what_is_held_of_an_ordinary_track_is_all_of_it():
    scenario = read_scenario(None, ())
    held = held_track(scenario)
    assert (held.keys, held.begin) == (scenario.track, 0.0)


def test_the_wheels_keep_away_from_the_ends_and_the_modes_their_density():
    scenario = read_scenario(None, ("track.endless=true", "flat.position=3", "run.approach=1"))
    held = held_track(scenario)
    last, first = scenario.start_position - 1.8, scenario.start_position + scenario.distance
    half = 25 * SPACING
    assert held.begin == pytest.approx(SPACING * held.first_bay)
    assert half <= last - held.begin < half + 2.0 * SPACING
    end = held.begin + held.keys.length
    assert half <= end - first < half + 2.0 * SPACING
    assert held.keys.retained_pairs == 3 * held.keys.bays
    assert not held.keys.endless


def test_a_passage_that_is_too_long_is_refused_with_a_remedy():
    long = ("track.endless=true", "flat.position=30", "run.approach=20")
    with pytest.raises(InputError, match=r"make run\.approach and run\.departure") as no:
        held_track(read_scenario(None, (*long, "run.departure=300")))
    less = float(str(no.value).rpartition("departure ")[2].split(" m")[0])
    held_track(read_scenario(None, (*long, f"run.departure={300 - less}")))


def held_supports(*keys):
    """Supports of what is held, and how many bays there are before their first one."""
    scenario = read_scenario(None, (*SHORT, "track.endless=true", "track.bays=6", *keys))
    held = held_track(scenario)
    return properties_of(scenario, held.keys, first_bay=held.first_bay), held.first_bay


def test_supports_of_an_endless_track_have_their_numbers_along_it():
    own, first = held_supports(
        "flat.position=103.6",
        "variation.hanging_sleepers=159",
        "variation.ballast_stiffness_deviation=0.4",
    )
    assert np.flatnonzero(own.gap) == [158 - first]
    random = ("track.bays=300", "variation.ballast_stiffness_deviation=0.4")
    long = properties_of(read_scenario(None, random), read_scenario(None, random).track)
    here = slice(first, first + len(own.gap))
    assert (own.ballast_stiffness == long.ballast_stiffness[here]).all()
    assert np.ptp(own.ballast_stiffness) > 0.1


def test_a_table_begins_anew_without_end_and_not_before_the_first_support(tmp_path):
    table = tmp_path / "supports.csv"
    table.write_text("number,sleeper_mass_factor,gap\n2,1.5,0\n5,1,1e-3\n")
    again = (f"track.supports={table}", "track.supports_repeat=true")
    far, first = held_supports("flat.position=103.6", *again)
    number = first + 1 + np.arange(len(far.gap))
    assert (far.own.sleeper_mass == np.where(number % 5 == 2, 62.5, 0.0)).all()
    assert (far.gap == np.where(number % 5 == 0, 1e-3, 0.0)).all()
    near, first = held_supports("flat.position=3", *again)
    number = first + 1 + np.arange(len(near.gap))
    assert number[0] < 0
    assert (near.gap == np.where((number % 5 == 0) & (number > 0), 1e-3, 0.0)).all()


@pytest.mark.parametrize("model", ["modal", "full"])
def test_an_endless_track_is_an_ordinary_one_elsewhere(model):
    """The same bays from 0 m on, with the wheels at the same places between the same sleepers."""
    scenario = read_scenario(None, ENDLESS)
    held = held_track(scenario)
    moved = (
        f"track.bays={held.keys.bays}",
        f"track.mode_pairs={held.keys.retained_pairs}",
        f"flat.position={103.6 - held.begin}",
        *SHORT,
    )
    times = np.linspace(0.0, 0.0048, 49)
    ours = solve(scenario, model=model, times=times)
    theirs = solve(read_scenario(None, moved), model=model, times=times)
    for name, scale in (("contact_force", 1e5), ("bending_moment", 1e4), ("rail_velocity", 0.1)):
        difference = np.abs(ours[name].to_numpy() - theirs[name].to_numpy()).max()
        # rounding of positions of 100 m, which may lead the integrator to other steps
        assert difference < 1e-4 * scale, name
    same = theirs["sleeper_displacement"].to_numpy()
    first = scenario.first_bay - held.first_bay
    shown = ours["sleeper_displacement"]
    assert np.abs(shown.to_numpy() - same[:, first : first + 5]).max() < 1e-8
    assert float(shown.max()) == pytest.approx(same.max(), abs=1e-8)
    assert float(abs(shown["sleeper_position"] - 103.6).min()) < 0.5 * SPACING
