"""The fixture as users have it: in test files of their own, run by a pytest of their own."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from railcosim.comparison import read_recording
from railcosim.pytest_plugin import Baseline

# hypothesis has a plugin that would be compiled anew in every pytest inside of this one
OPTIONS = ("-p", "railcosim.pytest_plugin", "-p", "no:hypothesispytest")

TEST = """
import numpy as np

def result(factor=1.0):
    times = np.linspace(0.0, 1.0, 101)
    rows = list(zip(times, factor * np.sin(6.0 * times), times))
    return np.array(rows, dtype=[("time", float), ("force", float), ("x", float)])

def test_train(baseline):
    baseline.check(result({factor}){more})
"""


@pytest.fixture(scope="module", autouse=True)
def _loaded(tmp_path_factory):
    """Load all that a check needs: a pytest inside of this one forgets what it loads itself."""
    folder = tmp_path_factory.mktemp("loaded")
    array = np.array([(0.0, 1.0), (1.0, 2.0)], dtype=[("time", float), ("x", float)])
    other = array.copy()
    other["x"] *= 2.0
    held = Baseline(
        folder=folder, name="x", update=True, evidence=lambda: folder, written=lambda _: None
    )
    held.check(array)
    with pytest.raises(pytest.fail.Exception):
        replace(held, update=False).check(other)


@pytest.fixture
def run(pytester):
    def run(*words, factor=1.0, more=""):
        pytester.makepyfile(test_train=TEST.format(factor=factor, more=more))
        return pytester.runpytest_inprocess(*OPTIONS, *words)

    return run


def test_a_missing_baseline_fails_and_is_not_written(run, pytester):
    ended = run()
    ended.assert_outcomes(failed=1)
    ended.stdout.fnmatch_lines(["*there is no baseline *test_train.nc*--update-baselines*"])
    assert not (pytester.path / "baselines").exists()


def test_a_baseline_is_written_when_asked_for_and_then_held(run, pytester):
    asked = run("--update-baselines")
    asked.assert_outcomes(passed=1)
    path = pytester.path / "baselines" / "test_train.nc"
    asked.stdout.fnmatch_lines([f"baseline written: {path}"])
    assert list(read_recording(path).series) == ["force", "x"]
    run().assert_outcomes(passed=1)


def test_what_differs_fails_with_the_table_and_a_figure(run, pytester):
    run("--update-baselines")
    before = (pytester.path / "baselines" / "test_train.nc").read_bytes()
    ended = run("--basetemp=kept", factor=1.01)
    ended.assert_outcomes(failed=1)
    ended.stdout.fnmatch_lines(
        ["*1 of 2 signals differ (force)*", "*force *DIFFERS*", "force: outside the tube *"]
    )
    figure = pytester.path / "kept" / "test_train0" / "test_train.png"
    ended.stdout.fnmatch_lines([f"figure: {figure}"])
    assert figure.read_bytes().startswith(b"\x89PNG")
    kept = read_recording(figure.with_suffix(".nc"))
    assert kept.series["force"].values.max() == pytest.approx(1.01, rel=1e-3)
    assert (pytester.path / "baselines" / "test_train.nc").read_bytes() == before


def test_a_baseline_is_renewed_only_where_the_result_differs(run, pytester):
    path = pytester.path / "baselines" / "test_train.nc"
    run("--update-baselines")
    before = path.read_bytes()
    unchanged = run("--update-baselines", factor=1.0 + 1e-6)
    assert path.read_bytes() == before
    unchanged.stdout.no_fnmatch_line("baseline written*")
    run("--update-baselines", factor=1.01)
    assert path.read_bytes() != before
    run(factor=1.01).assert_outcomes(passed=1)


def test_more_signals_renew_a_baseline(run, pytester):
    run("--update-baselines", more=", signals=['force']")
    path = pytester.path / "baselines" / "test_train.nc"
    assert list(read_recording(path).series) == ["force"]
    run().assert_outcomes(passed=1)  # one more is no difference
    run("--update-baselines")
    assert list(read_recording(path).series) == ["force", "x"]


def test_tolerances_come_from_a_file_or_an_object(run, pytester):
    run("--update-baselines")
    file = pytester.path / "tolerances.toml"
    file.write_text("[default]\nvalue = 0.02\n", encoding="utf-8")
    run(factor=1.01, more=f", {str(file)!r}").assert_outcomes(passed=1)
    wide = "__import__('railcosim.comparison').comparison.Tolerances(ignore=('force',))"
    run(factor=1.01, more=f", {wide}").assert_outcomes(passed=1)


def test_a_result_with_nan_makes_no_baseline_and_never_agrees(run, pytester):
    ended = run("--update-baselines", factor="float('nan')")
    ended.assert_outcomes(failed=1)
    ended.stdout.fnmatch_lines(["*force of the result has values that are no finite numbers*"])
    assert not (pytester.path / "baselines").exists()
    run("--update-baselines")
    run(factor="float('nan')").assert_outcomes(failed=1)


def test_paths_and_datasets_are_results_and_tests_have_several_baselines(pytester):
    pytester.makepyfile(
        """
        import numpy as np, xarray as xr, pytest

        @pytest.mark.parametrize("speed", [40, "a/b"])
        def test_train(baseline, tmp_path, speed):
            dataset = xr.Dataset({"x": ("time", [1.0, 2.0])}, coords={"time": [0.0, 1.0]})
            table = tmp_path / "table.csv"
            table.write_text("time,x\\n0.0,1.0\\n1.0,2.0\\n")
            baseline.check(dataset)
            baseline.check(table, name="other-" + str(speed).replace("/", "-"))
        """
    )
    written = pytester.runpytest_inprocess(*OPTIONS, "--update-baselines")
    written.assert_outcomes(passed=2)
    folder = pytester.path / "baselines"
    assert sorted(path.name for path in folder.iterdir()) == [
        "other-40.nc",
        "other-a-b.nc",
        "test_train_40.nc",
        "test_train_a_b.nc",
    ]
    pytester.runpytest_inprocess(*OPTIONS).assert_outcomes(passed=2)


def test_two_tests_do_not_write_one_baseline(pytester):
    text = "\ndef test_same(baseline):\n    baseline.check({!r})\n"
    for k in (1, 2):
        table = pytester.path / f"{k}.csv"
        table.write_text(f"time,x\n0.0,1.0\n1.0,{k}.0\n", encoding="utf-8")
        pytester.makepyfile(**{f"test_{k}": text.format(str(table))})
    ended = pytester.runpytest_inprocess(*OPTIONS, "--update-baselines")
    ended.assert_outcomes(passed=1, failed=1)
    ended.stdout.fnmatch_lines(["*same.nc is the baseline of test_1.py::test_same, too*"])


def test_the_folder_is_the_users_to_choose(run, pytester):
    pytester.makeconftest(
        """
        import pytest

        @pytest.fixture
        def baseline_folder(pytestconfig):
            return pytestconfig.rootpath / "kept" / "results"
        """
    )
    run("--update-baselines").assert_outcomes(passed=1)
    assert (pytester.path / "kept" / "results" / "test_train.nc").is_file()


def test_who_does_not_use_it_does_not_pay():
    code = "import sys, railcosim.pytest_plugin; print(*sys.modules)"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {"numpy", "scipy", "xarray", "pandas", "matplotlib", "fmpy", "rich"}
    assert heavy & set(ended.stdout.split()) == set()
