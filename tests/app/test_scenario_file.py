import pytest
from hypothesis import given
from hypothesis import strategies as st

from railcosim.errors import InputError
from railcosim.master_section import Master
from railcosim.scenario import Scenario
from railcosim.scenario_file import SECTIONS, from_toml, read_scenario, to_toml
from railcosim.sections import Flat, Run
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_nothing_given_is_the_default():
    assert read_scenario() == Scenario()


def test_a_file_replaces_defaults_and_overrides_replace_the_file(write):
    path = write("[vehicle]\nspeed_kmh = 60\naxle_load_t = 20\n[flat]\nshape = 'cusp'\n")
    case = read_scenario(path, ["vehicle.speed_kmh=35", "track.ballast=linear"])
    assert case.vehicle == Vehicle(speed_kmh=35.0, axle_load_t=20.0)
    assert case.flat == Flat(shape="cusp")
    assert case.track.ballast == "linear"


def test_the_last_override_wins():
    assert read_scenario(None, ["flat.depth=1e-3", "flat.depth=2e-3"]).flat.depth == 2e-3


def test_override_values_are_toml_or_plain_text():
    case = read_scenario(
        None, ["flat.periodic=true", "flat.wheel = 2", 'flat.shape="parabola"', "track.bays=60"]
    )
    assert case.flat == Flat(periodic=True, wheel=2, shape="parabola")
    assert case.track.bays == 60


def test_files_are_sought_beside_the_scenario_or_in_the_working_directory(
    write, tmp_path, monkeypatch
):
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    path = write("[flat]\nshape = 'tread.csv'\n[vehicle]\nspeed_table = 'v.csv'\n")
    case = read_scenario(path, ["vehicle.speed_table=w.csv"])
    assert case.flat.shape == str(tmp_path / "tread.csv")
    assert case.vehicle.speed_table == str(here / "w.csv")


@pytest.mark.parametrize(
    ("override", "parts"),
    [
        ("vehicle.sped_kmh=3", ["did you mean vehicle.speed_kmh", "speed_table", "wheel_mass"]),
        ("vehicle.depth=3", ["did you mean flat.depth"]),
        (
            "wagon.speed_kmh=3",
            [
                "wagon",
                "[track], [variation], [vehicle], [suspension], [flat], [run], [master]",
            ],
        ),
        ("speed_kmh=3", ["section.key=value", "--set vehicle.speed_kmh="]),
        ("flat.depth", ["section.key=value", "flat.depth"]),
        ("", ["section.key=value"]),
        ("vehicle.speed_kmh=", ["''", "a number in km/h"]),
    ],
)
def test_an_override_that_names_no_key_is_answered_with_the_nearest(override, parts):
    with pytest.raises(InputError) as caught:
        read_scenario(None, [override])
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[wagon]\n", ["wagon is no section"]),
        ("speed_kmh = 3\n", ["speed_kmh is no section", "did you mean vehicle.speed_kmh"]),
        ("vehicle = 3\n", ["vehicle is 3", "a section [vehicle]", "speed_kmh"]),
        ("[track]\nspacing = 0.6\n", ["track.spacing", "did you mean track.sleeper_spacing"]),
        ("[track\n", ["case.toml is not valid TOML", "line 1"]),
        ("[flat]\nwheel = 1\nwheel = 2\n", ["case.toml is not valid TOML"]),
    ],
)
def test_a_wrong_file_is_refused_in_one_sentence(write, text, parts):
    with pytest.raises(InputError) as caught:
        read_scenario(write(text))
    message = str(caught.value)
    assert "\n" not in message
    for part in parts:
        assert part in message


def test_a_file_that_is_no_text_is_refused(tmp_path):
    path = tmp_path / "case.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="not valid TOML"):
        read_scenario(path)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="No such file or directory"):
        read_scenario(tmp_path / "case.toml")


def test_the_resolved_text_holds_every_key_in_use():
    text = to_toml(Scenario())
    for section in SECTIONS:
        assert (f"[{section}]" in text) == (section != "keep")  # which keeps everything
    for line in ("position = 16.6", "speed_kmh = 40.0", "max_step = 0.0002"):
        assert f"\n{line}\n" in text
    assert "speed_table" not in text


def test_a_resolved_scenario_stays_what_it_is():
    text = to_toml(Scenario(vehicle=Vehicle(speed_table="/v.csv"), master=Master(min_step=1e-3)))
    assert "speed_kmh" not in text
    assert "\nmax_step = 0.001\n" in text
    assert to_toml(from_toml(text)) == text


finite = st.floats(min_value=1e-9, max_value=1e9)


@given(
    pad=finite,
    alpha=st.floats(-1e20, 1e20),
    speed=st.floats(0.1, 1e3),
    depth=st.floats(0.0, 0.02),
    name=st.text(max_size=20),
)
def test_reading_the_resolved_text_gives_the_same_passage_bit_for_bit(
    pad, alpha, speed, depth, name
):
    name = "/x" + "".join(c for c in name if c.isprintable() and c != "/") + ".csv"
    case = Scenario(
        track=Track(pad_stiffness=pad, ballast_alpha=alpha, mode_pairs=150),
        vehicle=Vehicle(speed_kmh=speed, rail_irregularity=name),
        flat=Flat(depth=depth, position=17.0, rolled=True),
        run=Run(approach=1.0),
        master=Master(algorithm="newton", step=1e-4),
    )
    assert from_toml(to_toml(case)) == case
