import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.evaluation.settings import Evaluation
from railcosim.evaluation.spectrum import contact_force_spectrum

PASSED = 1e-3  # ripple of the resampling
HANN = 1.5  # noise bandwidth of a Hann window, lines


def test_a_sine_gives_its_line(record, tone):
    found = contact_force_spectrum(record(tone(2e4, 250.0), tone(3e3, 1200.0), seconds=1.0))
    amplitude = found["contact_force_amplitude"]
    assert float(amplitude.sel(frequency=250.0, wheel=1)) == pytest.approx(2e4, rel=PASSED)
    chords = np.sinc(1200.0 * 20e-6) ** 2  # what straight lines between the points leave
    assert float(amplitude.sel(frequency=1200.0, wheel=2)) == pytest.approx(
        3e3 * chords, rel=PASSED
    )
    elsewhere = amplitude.sel(wheel=1).where(np.abs(found["frequency"] - 250.0) > 15.0, drop=True)
    # the ends of the filtered record are all that is left
    assert elsewhere.max() < 0.01 * 2e4


def test_the_density_of_a_sine_adds_up_to_its_mean_square(record, tone):
    found = contact_force_spectrum(record(tone(2e4, 250.0), seconds=1.0))
    density = found["contact_force_density"].sel(wheel=1)
    assert float(density.sum()) * 10.0 == pytest.approx(0.5 * 2e4**2, rel=3e-3)
    peak = 0.5 * 2e4**2 / (HANN * 10.0)
    assert float(density.sel(frequency=250.0)) == pytest.approx(peak, rel=2 * PASSED)


def test_white_noise_has_the_density_it_was_made_with(record):
    """Noise held over 20 us has the density ``2 sigma2 h``, here averaged over 19 segments."""
    rng = np.random.default_rng(2)
    noise = rng.normal(0.0, 1e4, 50_001)
    found = contact_force_spectrum(record(lambda _: 1e5 + noise, seconds=1.0))
    density = found["contact_force_density"].sel(wheel=1)
    exact = 2.0 * 1e4**2 * 20e-6
    spread = 1.0 / np.sqrt(19.0 * 0.5 * density.size)  # of the mean over the lines
    assert float(density.mean()) == pytest.approx(exact, rel=5.0 * spread)
    assert float(density.min()) > 0.15 * exact


def test_it_is_one_sided_and_ends_where_the_samples_do(record, tone):
    found = contact_force_spectrum(record(tone(1.0, 100.0)), Evaluation(resolution=20.0))
    frequency = found["frequency"].to_numpy()
    np.testing.assert_allclose(frequency, 20.0 * np.arange(1, 121))
    assert found.attrs == {"sampling_rate": 6000.0, "frequency_limit": 2400.0}
    for variable in found.variables.values():
        assert {"units", "long_name", "sign"} <= set(variable.attrs)


def test_a_tone_between_the_ends_of_spectrum_and_band_is_not_folded_back(record, tone):
    found = contact_force_spectrum(record(tone(1e4, 5000.0)))
    assert found["contact_force_amplitude"].sel(wheel=1)[2:].max() < 1e-3 * 1e4


def test_a_run_shorter_than_a_segment_is_refused(record, tone):
    with pytest.raises(InputError, match=r"resolution is 1 Hz but the run lasts only 0\.5 s"):
        contact_force_spectrum(record(tone(1.0, 100.0)), Evaluation(resolution=1.0))
