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
