import pytest

from railcosim.errors import InputError
from railcosim.input_tables import check_profiles, read_rail
from railcosim.motion import initial_speed, speed_law, travel_time
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run
from railcosim.vehicle_section import Vehicle


@pytest.fixture
def table(tmp_path):
    def table(text):
        path = tmp_path / "table.csv"
        path.write_text(text, encoding="utf-8")
        return str(path)

    return table


def test_constant_speed_takes_distance_over_speed():
    law = speed_law(Vehicle(speed_kmh=36.0))
    assert initial_speed(law) == pytest.approx(10.0, rel=1e-15)
    assert travel_time(law, 6.5) == pytest.approx(0.65, rel=1e-15)


def test_a_speed_table_gives_the_time_of_a_uniform_acceleration(table):
    """From 10 to 12 m/s in 1 s: s = 10 t + t2 = 11 m at t = 1 s, then 12 m/s."""
    law = speed_law(Vehicle(speed_table=table("time,speed\n0,10\n1,12\n")))
    assert initial_speed(law) == 10.0
    assert travel_time(law, 5.25) == pytest.approx(0.5, abs=1e-11)
    assert travel_time(law, 11.0) == pytest.approx(1.0, abs=1e-11)
    assert travel_time(law, 17.0) == pytest.approx(1.5, abs=1e-11)


def test_the_initial_speed_is_that_at_time_zero(table):
    assert initial_speed(speed_law(Vehicle(speed_table=table("-1,10\n1,12\n")))) == 11.0


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("0,10\n1,0\n", ["0 m/s at 1 s", "above zero"]),
        ("0,10\n1,nan\n", ["line 2", "speed", "nan"]),
        ("0,10\n0,11\n", ["must increase"]),
        ("0,10\n", ["1 points", "at least 2"]),
        ("0\n1\n", ["line 1", "not 2"]),
        ("", ["no rows"]),
    ],
)
def test_a_bad_speed_table_is_refused_by_name(table, text, parts):
    path = table(text)
    with pytest.raises(InputError) as caught:
        speed_law(Vehicle(speed_table=path))
    message = str(caught.value)
    assert "\n" not in message
    for part in [path, *parts]:
        assert part in message


def test_a_missing_table_is_refused_by_name(tmp_path):
    with pytest.raises(InputError, match=r"missing\.csv.*No such file or directory"):
        speed_law(Vehicle(speed_table=str(tmp_path / "missing.csv")))


def test_good_profiles_pass(table):
    profile = table("distance,drop\n-0.05,0\n-0.01,1e-3\n0.01,1e-3\n0.05,0\n")
    check_profiles(Scenario())
    check_profiles(Scenario(flat=Flat(shape=profile)))
    check_profiles(Scenario(flat=Flat(shape="none"), vehicle=Vehicle(rail_irregularity=profile)))


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("-0.05,0\n-0.01,nan\n0.01,1e-3\n0.05,0\n", ["line 2", "drop", "nan"]),
        ("-0.05,0\n-0.01,1e-3\n0.01,1e-3\n0.05,1e-4\n", ["must be zero"]),
        ("-2,0\n-1,1e-3\n1,1e-3\n2,0\n", ["circumference"]),
    ],
)
def test_a_bad_flat_profile_is_refused(table, text, parts):
    with pytest.raises(InputError) as caught:
        check_profiles(Scenario(flat=Flat(shape=table(text))))
    for part in parts:
        assert part in str(caught.value)


def test_a_bad_irregularity_is_refused(table):
    vehicle = Vehicle(rail_irregularity=table("0,0\n1,inf\n2,0\n3,0\n"))
    with pytest.raises(InputError, match="line 2"):
        check_profiles(Scenario(vehicle=vehicle))


def test_a_flat_longer_than_the_circumference_is_refused():
    with pytest.raises(InputError, match=r"3 m, the wheel's circumference is 2\.8"):
        check_profiles(Scenario(flat=Flat(length=3.0)))


def test_a_flat_deeper_than_the_wheel_is_refused():
    with pytest.raises(InputError, match=r"0\.02 m deep.*radius 0\.018 m"):
        check_profiles(
            Scenario(flat=Flat(depth=0.02, length=0.05), vehicle=Vehicle(wheel_radius=0.018))
        )


def test_a_run_starts_on_the_round_wheel(table):
    with pytest.raises(InputError, match=r"run\.approach is 0\.04 m .* 0\.05 m before"):
        check_profiles(Scenario(run=Run(approach=0.04)))
    profile = table("-0.3,0\n-0.01,1e-3\n0.01,1e-3\n0.05,0\n")
    with pytest.raises(InputError, match=r"begins 0\.3 m before"):
        check_profiles(Scenario(run=Run(approach=0.2), flat=Flat(shape=profile)))


@pytest.mark.parametrize("text", ["0;10,5\n1;12\n", "time;speed, m/s\n0,0;10,5\n1,0;12,5\n"])
def test_decimal_commas_are_refused(table, text):
    with pytest.raises(
        InputError, match=r"line \d: has both commas and semicolons; write decimals"
    ):
        speed_law(Vehicle(speed_table=table(text)))


def test_commas_and_semicolons_may_stand_in_the_names(table):
    assert initial_speed(speed_law(Vehicle(speed_table=table("t;v, m/s\n0;10\n1;12\n")))) == 10.0


def test_a_rail_in_millimetres_is_refused(table):
    path = table("0,0\n0.25,0.4\n0.5,-0.2\n0.75,0\n")
    sentence = r"changes by 2\.4 m per metre behind 0\.25 m, but at most 1 can"
    with pytest.raises(InputError, match=sentence):
        check_profiles(Scenario(vehicle=Vehicle(rail_irregularity=path)))
    with pytest.raises(InputError, match=sentence):
        read_rail(path)
    assert read_rail(path, 1e-3).drop[1] == 0.4
