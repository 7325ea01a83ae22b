"""A run that keeps some histories: what is kept is that of the whole run, and nothing is missed."""

import errno
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import orchestrator
from orchestrator import recorder
from railcosim.contact_loss import contact_losses
from railcosim.errors import InputError, RunError
from railcosim.keep_section import Keep
from railcosim.passage import run_passage
from railcosim.result_file import read_netcdf, read_passage
from railcosim.scenario_file import from_toml, read_scenario
from railcosim.signals import SIGNALS, signals_of
from railcosim.summary import summarise

ROUGH = Path(__file__).resolve().parents[2] / "examples" / "kilometres.toml"
SHORT = ("run.approach=4.0", "run.departure=8.0")  # the window moves, the flat strikes thrice
SIGNALS_KEPT = ("contact_force", "wheel_displacement", "sleeper_displacement", "bending_moment")
SPACING = 0.03


@pytest.fixture(scope="module")
def scenario():
    keep = Keep(signals=SIGNALS_KEPT, spacing=SPACING, stretch=5.0)
    return replace(read_scenario(ROUGH, SHORT), keep=keep)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmus")

    def run(scenario, **options):
        return run_passage(scenario, fmus="native", contact="track", directory=folder, **options)

    return run


@pytest.fixture(scope="module")
def whole(scenario, run):
    return run(replace(scenario, keep=Keep()))


@pytest.fixture(scope="module")
def thinned(scenario, run):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(recorder, "chunk_rows", 50)  # seams between blocks where anything happens
        return run(scenario)


def test_histories_are_those_of_the_whole_run_at_equal_distances(whole, thinned):
    """Bit for bit, the clamped ends included."""
    place = SPACING * np.arange(-133, 267)
    assert np.array_equal(thinned["distance"], place)
    assert np.array_equal(thinned["time"], np.interp(place, whole["distance"], whole["time"]))
    for name in SIGNALS_KEPT:
        assert thinned[name].attrs == whole[name].attrs
        for kept, every in zip(thinned[name].T, whole[name].T, strict=True):
            assert np.array_equal(kept, np.interp(place, whole["distance"], every))
    for name in whole.coords:
        if "time" not in whole[name].dims:
            assert thinned[name].identical(whole[name])
    names = {signal.name for signal in SIGNALS}
    assert names.isdisjoint(set(thinned.data_vars) - set(SIGNALS_KEPT))


def test_the_summary_is_that_of_every_step(whole, thinned):
    expected, found = summarise(whole).as_dict(), summarise(thinned).as_dict()
    run = found.pop("whole_run")
    for numbers in (expected, found):
        del numbers["wall_time"]
    assert found == expected
    force = whole["contact_force"]
    assert run["largest_contact_force"] == force.max()
    assert run["smallest_contact_force"] == force.min()
    peak = float(whole["distance"][int(force.max("wheel").argmax("time"))])
    begin = run["largest_contact_force_stretch"]
    assert begin <= peak < begin + 5.0
    losses = [contact_losses(whole["time"].to_numpy(), gap) for gap in whole["gap"].to_numpy().T]
    apart = max(sum(end - start for start, end in each) for each in losses)
    assert apart > 0.0
    # the sums differ in their rounding
    assert run["time_without_contact"] == pytest.approx(apart, rel=1e-9)


def test_extremes_of_stretches_are_those_of_every_step(whole, thinned):
    assert thinned["stretch"].to_numpy().tolist() == [-5.0, 0.0, 5.0]
    distance = whole["distance"].to_numpy()
    for begin in thinned["stretch"].to_numpy():
        inside = (distance >= begin) & (distance < begin + 5.0)
        for name in SIGNALS_KEPT:
            part, one = whole[name][inside], thinned.sel(stretch=begin)
            assert np.array_equal(one[f"{name}_largest"], part.max("time"))
            assert np.array_equal(one[f"{name}_smallest"], part.min("time"))


def test_peaks_fall_between_the_points_that_are_kept(thinned):
    """Why extremes are taken from every step."""
    largest = float(thinned["contact_force_largest"].max())
    assert float(thinned["contact_force"].max()) < 0.99 * largest


@pytest.fixture(scope="module")
def written(scenario, run, tmp_path_factory):
    path = tmp_path_factory.mktemp("written") / "kept.nc"
    return path, run(scenario, histories=path)


def test_what_is_written_on_the_way_is_the_same(scenario, thinned, written):
    path, head = written
    written = read_netcdf(path, "")
    assert list(written.variables) == list(thinned.variables)
    assert written.drop_attrs().identical(thinned.drop_attrs())
    assert "time" not in head.dims
    assert summarise(head) == summarise(written)
    assert from_toml(written.attrs["scenario"]).keep == scenario.keep


def stopping(error, *, at):
    def report(progress):
        if progress.time >= at:
            raise error

    return report


def test_a_run_that_fails_keeps_what_there_is(scenario, run, thinned, tmp_path):
    path = tmp_path / "kept.nc"
    with pytest.raises(RunError, match="a wheel came off") as caught:
        run(
            scenario,
            histories=path,
            report=stopping(orchestrator.RunError("a wheel came off."), at=0.15),
        )
    written = read_netcdf(path, "")
    assert caught.value.result.attrs["complete"] == written.attrs["complete"] == 0
    points = written.sizes["time"]
    assert 0 < points < thinned.sizes["time"]
    for name in ("distance", *SIGNALS_KEPT):
        assert np.array_equal(written[name], thinned[name][:points])
    assert summarise(written).peak_contact_force == summarise(thinned).peak_contact_force


def test_an_interrupted_run_has_no_numbers_of_a_strike_it_has_not_reached(scenario, run):
    result = run(scenario, report=stopping(KeyboardInterrupt(), at=0.05))
    summary = summarise(result)
    assert result.attrs["complete"] == 0
    assert summary.peak_contact_force is None
    assert summary.whole_run.largest_contact_force > 0.0


def test_an_interrupt_before_the_first_steps_leaves_nothing(scenario, run):
    with pytest.raises(RunError, match="before there was anything to keep"):
        run(scenario, report=stopping(KeyboardInterrupt(), at=0.0))


def test_a_full_disk_is_found_out_before_the_run(scenario, run, monkeypatch, tmp_path):
    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "posix_fallocate", full)
    with pytest.raises(RunError, match=r"no room in .* \(No space left on device\): free some"):
        run(scenario, histories=tmp_path / "kept.nc")


def test_a_thinned_result_is_refused_where_every_history_is_needed(written):
    path, _ = written
    with pytest.raises(InputError, match=r"has only contact_force, .* every 0\.03 m but every"):
        read_passage(path)


def test_a_suspended_vehicle_keeps_its_bodies():
    """With contact on the vehicle's side, and a spacing longer than some of its steps."""
    coach = ROUGH.with_name("coach.toml")
    short = read_scenario(coach, ["run.approach=0.1", "run.departure=0.1"])
    keep = Keep(signals=("bogie_acceleration", "secondary_force"), spacing=0.01)
    kept = run_passage(replace(short, keep=keep), fmus="native")
    every = run_passage(short, fmus="native")
    assert kept["bogie_acceleration"].dims == ("time", "bogie")
    expected = np.interp(kept["distance"], every["distance"], every["secondary_force"][:, 0])
    assert np.array_equal(kept["secondary_force"][:, 0], expected)
    assert "car_displacement" in {signal.name for signal in signals_of(short)}
    assert "car_displacement" not in kept


def test_any_reader_of_netcdf_finds_the_coordinates(written):
    path, _ = written
    with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as found:
        assert set(found["contact_force"].coords) == {"time", "distance", "wheel"}
        assert "gauge_position" in found.coords
        assert found.encoding["unlimited_dims"] == {"time"}
