import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.receptance.measured import MeasuredReceptance, log_residual, read_measured


@pytest.fixture
def table(tmp_path):
    def table(text):
        path = tmp_path / "measured.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return table


def test_with_and_without_phase(table):
    short = read_measured(table("frequency;amplitude\n20;1e-8\n30;2e-8\n"))
    assert short.phase is None
    assert short.amplitude.tolist() == [1e-8, 2e-8]
    full = read_measured(table("# hammer\n20 1e-8 -10\n30 2e-8 -20\n"))
    assert full.phase.tolist() == [-10.0, -20.0]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("20,1e-8\n30,2e-8,-20\n", ["line 2", "3 values, not 2"]),
        ("20,1e-8,-10\n30,2e-8\n", ["line 2", "2 values, not 3", "phase"]),
        ("20,1e-8,-10,7\n", ["line 1", "4 values, not 3"]),
        ("20,1e-8,nan\n", ["line 1", "phase", "nan"]),
        ("20,1e-8\n20,1e-8\n", ["20 Hz is followed by 20 Hz", "increase"]),
        ("0,1e-8\n20,1e-8\n", ["frequency is 0", "above 0"]),
        ("10,1e-8\n20,-1e-8\n", ["amplitude is -1e-08", "above 0"]),
        ("", ["no rows"]),
    ],
)
def test_bad_tables_are_refused_in_one_sentence(table, text, parts):
    path = table(text)
    with pytest.raises(InputError) as caught:
        read_measured(path)
    for part in [str(path), *parts]:
        assert part in str(caught.value)
    assert "\n" not in str(caught.value)


def test_residuals_are_log_amplitudes_then_phases():
    """Twice the amplitude; phases of -179 and 179 degrees are 2 degrees apart."""
    phase = np.array([-30.0, 179.0])
    measured = MeasuredReceptance(
        frequency=np.array([1.0, 2.0]), amplitude=np.array([1.0, 1.0]), phase=phase
    )
    calculated = 2.0 * np.exp(1j * np.deg2rad([-40.0, -179.0]))
    expected = [np.log(2.0), np.log(2.0), np.deg2rad(-10.0), np.deg2rad(2.0)]
    assert log_residual(calculated, measured) == pytest.approx(expected, rel=1e-12)


def test_a_part_of_the_frequencies():
    whole = MeasuredReceptance(
        frequency=np.array([1.0, 2.0, 3.0]),
        amplitude=np.array([1.0, 4.0, 9.0]),
        phase=np.array([-1.0, -2.0, -3.0]),
    )
    part = whole.between(1.5, 3.0)
    assert part.frequency.tolist() == [2.0, 3.0]
    assert part.amplitude.tolist() == [4.0, 9.0]
    assert part.phase.tolist() == [-2.0, -3.0]
