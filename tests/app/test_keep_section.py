import pytest

from railcosim.errors import InputError
from railcosim.keep_section import Keep
from railcosim.scenario import Scenario
from railcosim.scenario_file import from_toml, read_scenario, to_toml


def test_everything_is_kept_unless_a_scenario_says_otherwise():
    assert Scenario().keep == Keep()
    assert Keep().is_all
    assert "keep" not in to_toml(Scenario())


def test_a_resolved_scenario_keeps_the_same():
    keep = Keep(signals=["gap", "contact_force"], spacing=1, stretch=50)
    assert keep.signals == ("gap", "contact_force")
    text = to_toml(Scenario(keep=keep))
    assert '[keep]\nsignals = ["gap", "contact_force"]\nspacing = 1.0\nstretch = 50.0\n' in text
    assert from_toml(text).keep == keep


def test_keys_can_be_set_one_by_one():
    scenario = read_scenario(None, ["keep.signals=['pad_force']", "keep.spacing=0.5"])
    assert scenario.keep == Keep(signals=("pad_force",), spacing=0.5)


@pytest.mark.parametrize(
    ("keys", "parts"),
    [
        ({"signals": "gap"}, ["keep.signals is 'gap'", "a list of names"]),
        ({"signals": ["force"], "spacing": 1}, ["['force']", "must name some of contact_force"]),
        ({"signals": [[1]], "spacing": 1}, ["[[1]]", "must name some of"]),
        ({"signals": ["in_contact"], "spacing": 1}, ["must name some of contact_force, gap"]),
        ({"signals": ["gap", "gap"], "spacing": 1}, ["name every signal once"]),
        ({"signals": ["gap"]}, ["keep.spacing is missing"]),
        ({"spacing": 1}, ["keep.signals names nothing"]),
        ({"signals": ["gap"], "spacing": 1e-9}, ["keep.spacing is 1e-09", "at least 1e-05 m"]),
        ({"signals": ["gap"], "spacing": float("nan")}, ["keep.spacing is nan"]),
        ({"signals": ["gap"], "spacing": float("inf")}, ["keep.spacing is inf"]),
        ({"signals": ["gap"], "spacing": True}, ["keep.spacing is True"]),
        ({"stretch": 0.5}, ["keep.stretch is 0.5", "at least 1 m"]),
    ],
)
def test_wrong_keys_are_refused_in_a_sentence(keys, parts):
    with pytest.raises(InputError) as caught:
        Keep(**keys)
    for part in parts:
        assert part in str(caught.value)


def test_a_passage_keeps_only_what_it_has():
    with pytest.raises(InputError, match=r"keep\.signals has car_pitch but a passage of this"):
        Scenario(keep=Keep(signals=("car_pitch",), spacing=0.1))


@pytest.mark.parametrize(
    ("start", "end", "expected"),
    [(-0.3, 0.3, (-3, 4)), (-0.29, 0.29, (-2, 3)), (0.01, 0.02, (1, 1))],
)
def test_points_are_the_multiples_within(start, end, expected):
    assert Keep(signals=("gap",), spacing=0.1).grid(start, end) == expected


def test_what_needs_every_history_says_so():
    Keep().need_all("railcosim verify")
    with pytest.raises(InputError) as caught:
        Keep(signals=("gap", "pad_force"), spacing=0.25).need_all("railcosim verify")
    assert str(caught.value) == (
        "railcosim verify needs every history at every step but the scenario keeps gap, pad_force "
        "every 0.25 m: take its [keep] out"
    )
