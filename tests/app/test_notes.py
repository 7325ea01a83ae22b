import pytest

from railcosim.notes import notes
from railcosim.scenario_file import from_toml, read_scenario


@pytest.mark.parametrize(
    ("overrides", "parts"),
    [
        ((), []),
        (("flat.shape=chord",), ["the chord has a kink"]),
        (
            ("flat.shape=chord", "flat.depth=1e-3"),
            ["a chord of 100 mm is 2.78 mm deep", "the frequencies of its 150 mode pairs"],
        ),
        (("flat.shape=cusp",), ["take track.mode_pairs=400"]),
        (("flat.shape=parabola", "track.bays=60"), ["track.mode_pairs=480"]),
        (("flat.shape=cusp", "track.mode_pairs=400"), []),
        (
            ("flat.shape=cusp", "track.elements_per_bay=1", "track.mode_pairs=147"),
            [],
        ),  # all of them
        (("flat.shape=none",), []),
        (("master.step=1e-3",), ["steps up to 0.001 s do not resolve"]),
        (("master.max_step=1e-4",), []),
    ],
)
def test_what_may_surprise_is_said(overrides, parts):
    said = notes(read_scenario(None, overrides))
    assert len(said) == len(parts)
    assert all(part in sentence for part, sentence in zip(parts, said, strict=True))


@pytest.mark.parametrize(
    ("defect", "said"),
    [
        ('kind = "spall"\nwheel = 2', ["the spall of wheel 2 has a kink"]),
        ('kind = "flat"\nshape = "cusp"', ["the flat of wheel 1 has a kink"]),
        ('kind = "flat"', []),
        ('kind = "polygon"\norder = 5\namplitude = 1e-4', []),
    ],
)
def test_every_dent_with_a_kink_needs_modes(defect, said):
    found = notes(from_toml(f"[[wheel_defect]]\n{defect}"))
    assert len(found) == len(said)
    assert all(part in sentence for part, sentence in zip(said, found, strict=True))
    enough = from_toml(f"[track]\nmode_pairs = 400\n[[wheel_defect]]\n{defect}")
    assert notes(enough) == []


def test_keys_without_effect_on_a_track_with_contacts_are_named():
    case = read_scenario(None, ("master.tolerance=1e-4", "master.max_step=1e-4"))
    assert notes(case) == []
    (said,) = notes(case, "track")
    assert said.startswith("master.tolerance, master.max_step has no effect with contact on the")
    named = read_scenario(None, ("master.tolerance=1e-4", "master.algorithm=newton"))
    assert notes(named, "track") == []


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        (("variation.ballast_stiffness_deviation=0.3",), "take track.supports_per_wheel=10"),
        (("variation.transition_factor=2", "variation.transition_begin=16"), "by 1 %"),
        (("track.ballast_mass=30",), "act on more than the 6 nearest supports"),
        (("track.ballast_mass=30", "track.supports_per_wheel=10"), None),
        (("variation.hanging_sleepers=25",), None),
        (("variation.missing_fastenings=25",), None),
        (("variation.sleeper_mass_deviation=0.3",), None),
    ],
)
def test_increments_in_proportion_to_the_deflection_need_many_supports(overrides, said):
    found = notes(read_scenario(None, overrides))
    assert len(found) == (said is not None)
    assert said is None or said in found[0]


def test_a_table_of_supports_is_looked_into_while_it_is_there(tmp_path):
    table = tmp_path / "supports.csv"
    case = read_scenario(None, (f"track.supports={table}",))
    assert notes(case) == []
    table.write_text("number,gap\n25,1e-3\n", encoding="utf-8")
    assert notes(case) == []
    table.write_text("number,ballast_stiffness_factor\n25,2\n", encoding="utf-8")
    (said,) = notes(case)
    assert "track.supports_per_wheel=10" in said


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ((), None),
        (("track.bays=20",), None),  # 6.1 bays
        (
            ("track.bays=15", "flat.position=16.6"),
            "leaves 4.1 of them between its clamped ends and a wheel",
        ),
        (("track.bays=18",), "take track.bays=19"),
        (("vehicle.preset=manchester_coach", "flat.position=30"), "a window of 50 bays leaves 2.9"),
        (("vehicle.preset=manchester_coach", "flat.position=30"), "take track.bays=58"),
        (("vehicle.preset=manchester_coach", "flat.position=30", "track.bays=58"), None),
    ],
)
def test_a_window_must_be_longer_than_the_vehicle_in_it(overrides, said):
    found = notes(read_scenario(None, ("track.endless=true", *overrides)))
    assert len(found) == (said is not None)
    assert said is None or said in found[0]
