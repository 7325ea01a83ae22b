"""Studies as they run: what is stored, what is repeated, what fails, what the result holds."""

import json
import os
import time

import numpy as np
import pytest

from railcosim.errors import BuildError, InputError, RunError
from railcosim.output import write_dataset
from railcosim.passage import run_passage
from railcosim.summary import summarise
from railcosim.sweep import SweepProgress, engine, parse_study, run_study, work
from railcosim.sweep.numbers import NUMBERS
from railcosim.sweep.store import ABANDONED, MARK, Record, open_store

SPEEDS = "[sweep.grid]\nvehicle.speed_kmh = [60, 80]\n"
KEEP = "[keep]\nsignals = ['contact_force', 'sleeper_displacement']\nspacing = 0.01\n"
ONE_FAILS = "master.min_step = 2e-5\n[sweep.grid]\nmaster.tolerance = [2e-3, 1e-9]\n"


@pytest.fixture
def stub(monkeypatch):
    """Let cases end without being run."""
    run = []

    def run_stub(case, _):
        run.append(case.swept)
        numbers = dict.fromkeys(NUMBERS, float(case.number))
        return Record(swept=case.swept, numbers=numbers), None

    monkeypatch.setattr(work, "_run", run_stub)
    return run


def test_a_result_holds_the_numbers_and_histories_of_the_passages(sweep, cheap):
    """Those of a passage run by itself, bit for bit."""
    result, _ = sweep(SPEEDS + KEEP)
    case = parse_study(cheap + SPEEDS).case(1)
    passage = run_passage(case.scenario, fmus="python")
    one = result.sel({"vehicle.speed_kmh": 80.0})
    summary = summarise(passage)
    for name in ("peak_contact_force", "min_contact_force", "max_sleeper_displacement"):
        assert one[name].item() == getattr(summary, name)
    assert one["steps_accepted"].item() == summary.steps.accepted
    assert one["iterations"].item() == summary.steps.iterations
    np.testing.assert_allclose(result["distance"], np.arange(-15, 12) * 0.01, rtol=1e-15)
    for name in ("contact_force", "sleeper_displacement"):
        for column, stored in zip(passage[name].to_numpy().T, one[name].to_numpy().T, strict=True):
            expected = np.interp(result["distance"], passage["distance"], column)
            assert (stored == expected).all()
    assert result["peak_contact_force"].attrs["units"] == "N"
    assert result.attrs["fmu_guids"].splitlines() == sorted(
        passage.attrs[f"{name}_fmu_guid"] for name in ("track", "vehicle")
    )


def test_what_is_stored_is_not_run_again(sweep, stub):
    first, progress = sweep(SPEEDS)
    assert progress == SweepProgress(total=2, stored=0, ended=2, failed=0)
    again, progress = sweep(SPEEDS)
    assert progress == SweepProgress(total=2, stored=2, ended=0, failed=0)
    assert first.identical(again)
    _, progress = sweep(SPEEDS.replace("80", "80, 90"))
    assert progress == SweepProgress(total=3, stored=2, ended=1, failed=0)
    assert stub == [{"vehicle.speed_kmh": speed} for speed in (60, 80, 90)]


def test_the_same_passage_is_run_once(sweep, stub):
    result, _ = sweep("[[sweep.list]]\nflat.wheel = 1\n" * 2)
    assert len(stub) == 1
    assert result["peak_contact_force"].to_numpy().tolist() == [1.0, 1.0]


def test_a_case_that_fails_is_recorded_and_the_rest_goes_on(sweep):
    """A tolerance that the smallest step allowed cannot meet."""
    result, progress = sweep(ONE_FAILS)
    assert progress == SweepProgress(total=2, stored=0, ended=2, failed=1)
    good, bad = (result.isel({"master.tolerance": n}) for n in (0, 1))
    assert good["failure"].item() == ""
    assert "at t = " in bad["failure"].item()
    for name in NUMBERS:
        assert np.isfinite(good[name].item())
        assert np.isnan(bad[name].item())
    assert result.attrs["failed_cases"] == 1
    same, progress = sweep(ONE_FAILS)
    assert progress == SweepProgress(total=2, stored=2, ended=0, failed=0)
    assert same.identical(result)
    _, progress = sweep(ONE_FAILS, retry_failed=True)
    assert progress == SweepProgress(total=2, stored=1, ended=1, failed=1)


def test_an_unforeseen_exception_is_kept_with_all_it_says(sweep, tmp_path, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("by nothing")

    monkeypatch.setattr(work, "_run", broken)
    result, _ = sweep(SPEEDS)
    assert result["failure"].to_numpy().tolist() == ["ZeroDivisionError: by nothing"] * 2
    for path in (tmp_path / "store").glob("[0-9a-f]*.json"):
        assert 'raise ZeroDivisionError("by nothing")' in json.loads(path.read_text())["traceback"]


@pytest.mark.parametrize("error", [BuildError("there is no compiler"), RunError("disk is full")])
def test_what_does_not_lie_with_a_case_ends_the_study(sweep, tmp_path, monkeypatch, error):
    """And is not recorded as the case's failure."""

    def broken(*_):
        raise error

    target = (work, "_run") if isinstance(error, BuildError) else (engine, "run_case_on_worker")
    monkeypatch.setattr(*target, broken)
    with pytest.raises(type(error), match=str(error)):
        sweep(SPEEDS)
    assert [path.name for path in (tmp_path / "store").iterdir()] == [MARK]


def test_a_worker_that_sees_other_files_or_no_store_ends_the_study(sweep, monkeypatch):
    monkeypatch.setattr(work, "content_key", lambda *_: "another")
    with pytest.raises(RunError, match=r"other files than case 1 \(vehicle.speed_kmh = 60\)"):
        sweep(SPEEDS)
    monkeypatch.setattr("railcosim.sweep.store.Store.is_there", lambda _: False)
    with pytest.raises(RunError, match="does not see the store"):
        sweep(SPEEDS)


def test_files_count_by_their_content_and_not_by_their_place(sweep, stub, tmp_path):
    text = "flat.shape = 'tread.csv'\n[sweep.grid]\nvehicle.speed_kmh = [60]\n"
    rows = [f"{x},{1e-3 - abs(x) / 40}" for x in (-0.04, -0.02, 0.0, 0.02, 0.04)]
    here, there = (tmp_path / name for name in ("here", "there"))
    for folder in (here, there):
        folder.mkdir()
        (folder / "tread.csv").write_text("\n".join(rows))
    first, _ = sweep(text, folder=here)
    assert sweep(text, folder=there)[1].ended == 0
    assert sweep(text, folder=there)[0].identical(first)
    assert first.attrs["files"].endswith("  tread.csv")
    rows[2] = "0.0,0.0011"
    (there / "tread.csv").write_text("\n".join(rows))
    assert sweep(text, folder=there)[1].ended == 1
    assert len(stub) == 2


def test_every_case_is_checked_before_the_first_one_runs(sweep, stub, tmp_path):
    for wrong in ("[60, 0.01]", "[60]\nflat.shape = ['cusp', 'missing.csv']"):
        with pytest.raises(InputError, match=r"^case 2 \("):
            sweep(f"[sweep.grid]\nvehicle.speed_kmh = {wrong}\n")
    assert stub == []
    assert not (tmp_path / "store").exists()


def test_histories_need_the_same_number_of_wheels(sweep, stub):
    with pytest.raises(InputError, match="contact_force but the cases differ in their number of w"):
        sweep("vehicle.axle_base = 1.0\n[sweep.grid]\nvehicle.wheels = [1, 2]\n" + KEEP)
    assert stub == []


def test_histories_reach_as_far_as_the_shortest_case(sweep):
    result, _ = sweep("[sweep.grid]\nrun.approach = [0.15, 0.2]\n" + KEEP)
    np.testing.assert_allclose(result["distance"], np.arange(-15, 12) * 0.01, rtol=1e-15)
    force = result["contact_force"].to_numpy()
    assert np.isfinite(force).all()
    # the same flat, met after another approach
    np.testing.assert_allclose(force[0, 15:], force[1, 15:], rtol=0.05)


def test_a_damaged_case_is_run_again(sweep, tmp_path):
    result, _ = sweep(SPEEDS + KEEP)
    first, second = sorted((tmp_path / "store").glob("[0-9a-f]*.json"))
    first.write_text(first.read_text()[:50])
    second.with_suffix(".npz").write_bytes(b"PK")
    again, progress = sweep(SPEEDS + KEEP)
    assert progress.ended == 2
    assert again.identical(result)


def test_a_store_is_an_empty_folder_or_a_store(tmp_path):
    (tmp_path / "thesis.docx").touch()
    with pytest.raises(InputError, match="holds other files than cases"):
        open_store(tmp_path)
    with pytest.raises(InputError, match="no usable folder"):
        open_store(tmp_path / "thesis.docx")


def test_what_killed_processes_left_is_removed_from_a_store(tmp_path):
    folder = tmp_path / "store"
    open_store(folder)
    old, new = (folder / f".railcosim-{name}" for name in ("old", "new"))
    for left in (old, new):
        left.mkdir()
    hours_ago = time.time() - 2.0 * ABANDONED
    os.utime(old, (hours_ago, hours_ago))
    store = open_store(folder)
    assert not old.exists()
    assert new.exists()
    assert store.keys() == set()


@pytest.mark.usefixtures("stub")
def test_the_result_file_is_the_same_to_the_byte(sweep, tmp_path):
    text = "[[sweep.list]]\nflat.shape = 'cusp'\nflat.periodic = true\n" + SPEEDS
    for name in ("a", "b"):
        result, _ = sweep(text, store=tmp_path / name)
        write_dataset(result, tmp_path / f"{name}.nc")
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


@pytest.mark.usefixtures("stub")
def test_a_study_runs_from_its_file(cheap, client, tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(cheap + SPEEDS)
    result = run_study(path, store=tmp_path / "store", client=client)
    assert result.attrs["study"] == path.read_text()
    assert dict(result.sizes) == {"vehicle.speed_kmh": 2}
