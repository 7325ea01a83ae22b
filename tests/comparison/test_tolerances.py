import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railcosim.comparison import Tolerance, Tolerances, read_tolerances
from railcosim.comparison.tolerances import matches
from railcosim.errors import InputError

FILE = """
interval = inf
ignore = ["*.debug"]

[default]
value = 0.01

[signals."contact_force*"]
time = 1e-4
value = 0.02

[signals."contact_force[1]"]
value = 0.005
peak = 0.003
"""


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "tolerances.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_later_patterns_replace_what_earlier_ones_say(write):
    tolerances = read_tolerances(write(FILE))
    assert tolerances.of("gap[1]") == Tolerance(value=0.01)
    assert tolerances.of("contact_force[2]") == Tolerance(value=0.02, time=1e-4)
    assert tolerances.of("contact_force[1]") == Tolerance(value=0.005, time=1e-4, peak=0.003)
    assert tolerances.interval == math.inf
    assert tolerances.ignores("track.debug")
    assert not tolerances.ignores("track.force")


def test_an_empty_file_is_the_default(write):
    assert read_tolerances(write("")) == Tolerances()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[default]\nvalue = -1", ["value", "-1", "from 0 up"]),
        ("[default]\nvalue = nan", ["value", "nan", "from 0 up"]),
        ("[default]\nvalue = true", ["value", "True"]),
        ("[default]\ntime = '1 ms'", ["time", "1 ms"]),
        ("[default]\nrms = 1.0", ["'rms'", "default", "nrms"]),
        ("[signals.force]\nvalu = 1.0", ["'valu'", "force", "value"]),
        ("[signals]\nforce = 1.0", ["force", "table"]),
        ("tolerance = 1.0", ["'tolerance'", "default, signals, ignore, interval"]),
        ("default = 3", ["default", "table"]),
        ("ignore = '*'", ["ignore", "list"]),
        ("interval = -0.1", ["interval", "-0.1"]),
        ("[default", ["TOML"]),
    ],
)
def test_a_wrong_file_is_refused_by_name(write, text, words):
    path = write(text)
    with pytest.raises(InputError) as refused:
        read_tolerances(path)
    for word in (str(path), *words):
        assert word in str(refused.value)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="check the path"):
        read_tolerances(tmp_path / "none.toml")


@given(name=st.text(max_size=20))
def test_a_name_is_of_its_own_pattern_and_of_any_text(name):
    assert matches(name, name)
    assert matches(name, "*")
    assert matches(f"wheel[1].{name}", "wheel[?].*")
    assert not matches(f"1{name}", "[1]*")
