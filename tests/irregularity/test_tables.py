"""Irregularities and wheel defects in scenario files."""

import pytest

from railcosim.errors import InputError
from railcosim.rail_sections import Corrugation, FraTrack, Iso3095Roughness, Joint, MeasuredRail
from railcosim.scenario import Scenario
from railcosim.scenario_file import from_toml, read_scenario, to_toml
from railcosim.vehicle_section import Vehicle
from railcosim.wheel_sections import MeasuredWheel, Polygon, Spall, WheelFlat
from vehicle_fmu.hertz_coefficient import hertz_coefficient

TEXT = """
[surface]
contact_filter = true

[[irregularity]]
kind = "iso3095"
seed = 4
begin = 14

[[irregularity]]
kind = "joint"
position = 16.9
depth = 1e-3

[[wheel_defect]]
kind = "spall"
wheel = 2

[[wheel_defect]]
kind = "csv"
file = "wheel.csv"
"""


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_tables_of_every_kind_are_read_in_their_order(write, tmp_path):
    case = read_scenario(write(TEXT))
    assert case.irregularity == (
        Iso3095Roughness(seed=4, begin=14.0),
        Joint(position=16.9, depth=1e-3),
    )
    assert case.wheel_defect == (
        Spall(wheel=2),
        MeasuredWheel(file=str(tmp_path / "wheel.csv")),
    )
    assert not case.is_smooth


def test_one_table_is_replaced_by_its_number(write):
    case = read_scenario(write(TEXT), ["irregularity[1].seed=9", "wheel_defect[1].kind=flat"])
    assert case.irregularity[0] == Iso3095Roughness(seed=9, begin=14.0)
    assert case.wheel_defect[0] == WheelFlat(wheel=2)


def test_the_resolved_text_gives_the_same_scenario():
    case = Scenario(
        irregularity=(
            FraTrack(track_class=3, seed=2**40),
            Corrugation(phase_deg=0.1),
            MeasuredRail(file="/rail.csv", scale=-1e-6, end=20.0),
            Joint(position=17.0, angle=0.02),
        ),
        wheel_defect=(Polygon(order=20, level_db=12.5), Polygon(order=3, amplitude=1e-4, wheel=2)),
    )
    again = from_toml(to_toml(case))
    assert again.irregularity == case.irregularity
    assert again.wheel_defect == case.wheel_defect
    assert to_toml(again) == to_toml(case)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[[irregularity]]\nseed = 1\n", ["irregularity.kind is missing", "iso3095, german, fra"]),
        ("[[irregularity]]\nkind = 'rough'\n", ["irregularity.kind is 'rough'", "corrugation"]),
        ("[[irregularity]]\nkind = 3\n", ["irregularity.kind is 3"]),
        (
            "[[irregularity]]\nkind = 'fra'\nlevel_db = 3\n",
            ["irregularity.level_db is no key of the kind fra", "track_class"],
        ),
        ("[[irregularity]]\nkind = 'fra'\ntrack_class = 7\n", ["7", "at most 6"]),
        ("[[irregularity]]\nkind = 'fra'\nshortest_wavelength = 200\n", ["200 m", "below"]),
        ("[[irregularity]]\nkind = 'joint'\n", ["irregularity.position is missing"]),
        (
            "[[irregularity]]\nkind = 'joint'\nposition = 1\ndepth = 1e-3\nangle = 0.01\n",
            ["both given"],
        ),
        (
            "[[irregularity]]\nkind = 'joint'\nposition = 1\nshape = 'haversine'\n",
            ["irregularity.depth is missing"],
        ),
        ("[[irregularity]]\nkind = 'iso3095'\nbegin = 3\nend = 2\n", ["2 m", "above", "3 m"]),
        ("[[irregularity]]\nkind = 'csv'\nfile = ''\n", ["path of a .csv file"]),
        ("[irregularity]\nkind = 'fra'\n", ["must be tables [[irregularity]]"]),
        ("irregularity = 3\n", ["irregularity is 3"]),
        ("[[wheel_defect]]\nkind = 'polygon'\norder = 3\n", ["neither is given"]),
        (
            "[[wheel_defect]]\nkind = 'polygon'\norder = 3\namplitude = 1e-4\nlevel_db = 1\n",
            ["both are given"],
        ),
        ("[[wheel_defect]]\nkind = 'flat'\nwheel = 3\n", ["3", "has 2 wheels"]),
        (
            "[vehicle]\nrail_irregularity = 'a.csv'\n[[irregularity]]\nkind = 'fra'\n",
            ["both given", "kind csv"],
        ),
    ],
)
def test_wrong_tables_are_refused_in_one_sentence(write, text, parts):
    with pytest.raises(InputError) as caught:
        read_scenario(write(text))
    message = str(caught.value)
    assert "\n" not in message
    for part in parts:
        assert part in message


@pytest.mark.parametrize(
    ("override", "sentence"),
    [
        ("irregularity[3].seed=1", r"irregularity\[3\] is no table of this scenario.* 2 of"),
        ("irregularity[0].seed=1", r"irregularity\[0\] is no table"),
        ("irregularity.seed=1", r"a list of tables: name one of them"),
        ("wagon[1].seed=1", r"wagon\[1\] is no section"),
    ],
)
def test_options_that_name_no_table_are_refused(write, override, sentence):
    with pytest.raises(InputError, match=sentence):
        read_scenario(write(TEXT), [override])


def test_the_hertz_coefficient_follows_from_radii_and_material():
    vehicle = Vehicle(rail_radius=0.3, youngs_modulus=210e9, wheel_radius=0.46)
    expected = hertz_coefficient(wheel_radius=0.46, rail_radius=0.3, youngs_modulus=210e9)
    assert vehicle.hertz_coefficient == expected
    assert Vehicle(rail_radius=0.3).hertz_coefficient == pytest.approx(9.18e10, rel=5e-4)
    case = Scenario(vehicle=vehicle)
    assert from_toml(to_toml(case)).vehicle.hertz_coefficient == expected


def test_two_hertz_coefficients_are_refused():
    with pytest.raises(InputError, match=r"8e\+10 N/m1.5 but that of vehicle.rail_radius = 0.3"):
        Vehicle(rail_radius=0.3, hertz_coefficient=8e10)
    with pytest.raises(InputError, match="the contact is a line"):
        Vehicle(rail_radius=100.0, wheel_radius=1e-12)
