"""The native FMUs of TrackContact and Masses: what they claim, and passages over them."""

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from fmu_src.building import KINDS, ensure_fmus, ensure_native_fmus
from fmu_src.structure import Structure
from orchestrator import check_fmu
from railcosim.builds import build_for
from railcosim.cosim import run_system
from railcosim.cosim_options import CosimOptions
from railcosim.passage import run_passage
from railcosim.passage_package import ensure_package
from railcosim.scenario_file import read_scenario

from .fmi_calls import OK

AGREEMENT = 1e-9  # of the largest value of a history
SHORT = ("run.approach=0.15", "run.departure=0.25")
HISTORIES = (
    "contact_force",
    "gap",
    "wheel_displacement",
    "wheel_velocity",
    "rail_displacement",
    "rail_velocity",
    "sleeper_displacement",
    "pad_force",
    "ballast_force",
    "bending_moment",
    "bending_moment_under_wheel",
)


def paths_of(pair):
    return (pair.track, pair.vehicle)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("built")


# what they claim


def described(path):
    return {
        variable.name: (variable.valueReference, variable.unit, variable.description)
        for variable in fmpy.read_model_description(path).modelVariables
        if variable.causality != "independent" and not variable.dimensions
    }


def test_archives_keep_to_the_standard_and_have_the_variables_of_the_python_ones(
    contact_fmus, tmp_path, small
):
    python = ensure_fmus(tmp_path, small, contact="track")
    for pair in contact_fmus.values():
        for path, other in zip(paths_of(pair), paths_of(python), strict=True):
            assert validate_fmu(str(path)) == []
            assert described(path) == described(other)


@pytest.mark.parametrize("wheels", [1, 4])
def test_any_number_of_wheels(tmp_path, wheels):
    structure = Structure(bays=13, elements_per_bay=4, wheels=wheels, gauges=0)
    for version in (2, 3):
        pair = ensure_native_fmus(tmp_path, structure, contact="track", fmi_version=version)
        for path in paths_of(pair):
            assert validate_fmu(str(path)) == []
        names = described(pair.vehicle)
        assert [k for k in range(1, wheels + 2) if f"wheel[{k}].offset" in names] == list(
            range(2, wheels + 1)
        )


@pytest.mark.slow
def test_all_claims_hold(contact_fmus):
    for pair in contact_fmus.values():
        for path in paths_of(pair):
            assert [item for item in check_fmu(path) if not item.holds] == []


# doubts


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("logging", [True, False])
def test_a_host_with_long_steps_is_told_once(fmi, version, logging):
    """Also where it asks for no log."""
    track = fmi(version, "track_contact", logging=logging).start()
    assert track.step(0.0, 1e-3)[0] == OK
    assert track.step(1e-3, 1e-3)[0] == OK
    ((category, message),) = track.messages
    assert category == "logStatusWarning"
    assert message.startswith("steps of 0.001 s are too long")


@pytest.mark.parametrize("version", [2, 3])
def test_a_host_that_steps_the_vehicle_first_is_told_what_to_set(fmi, version):
    track = fmi(version, "track_contact").start()
    place = track.get("wheel[1].position")[0]
    track.must(track.put("wheel[1].position", place + 1e-3))
    assert track.step(0.0, 1e-4)[0] == OK
    assert "set linear_inputs = true" in track.message
    told = fmi(version, "track_contact").start(linear_inputs=True)
    told.must(told.put("wheel[1].position", place + 1e-3))
    assert told.step(0.0, 1e-4)[0] == OK
    assert told.messages == []


def test_a_step_ends_at_a_loss_of_contact_if_the_host_allows_it(fmi):
    """Within the step, to 1e-9 s; then it goes on."""
    early = fmi(3, "track_contact", early_return=True).start(linear_inputs=True)
    early.must(early.put("wheel[1].displacement", -3e-3))
    status, reached = early.step(0.0, 1e-3)
    assert (status, early.early) == (OK, True)
    assert 0.0 < early.get("wheel[1].gap")[0] < 1e-8
    assert early.get("wheel[1].displacement")[0] == pytest.approx(-3.0 * reached, rel=1e-12)
    early.must(early.put("wheel[1].displacement", -3e-3))
    assert early.step(reached, 1e-3 - reached) == (OK, 1e-3)
    assert not early.early


def test_late_in_a_simulation_a_step_ends_as_near_to_the_loss_as_its_time_can_tell(fmi):
    """Contact is lost 4e-9 s into the step, and times of 1e10 s are 2e-6 s apart."""
    time = 1e10
    early = fmi(3, "track_contact", early_return=True).start(time, linear_inputs=True)
    early.must(early.put("wheel[1].displacement", -30.0))
    status, reached = early.step(time, 1e-3)
    assert (status, early.early) == (OK, True)
    assert time < reached <= time + 8.0 * np.spacing(time)


# passages


def assert_same(case, folder):
    python, native = (
        run_passage(case, fmus=kind, contact="track", directory=folder / kind) for kind in KINDS
    )
    for name in HISTORIES:
        expected = python[name].to_numpy()
        limit = AGREEMENT * np.max(np.abs(expected))
        np.testing.assert_allclose(native[name], expected, rtol=0.0, atol=limit, err_msg=name)
    return native


@pytest.mark.parametrize("depth", ["9e-4", "2e-3"])
def test_a_passage_is_that_of_the_python_fmus(folder, depth):
    """A deep flat loses contact and finds it again."""
    native = assert_same(read_scenario(None, (*SHORT, f"flat.depth={depth}")), folder)
    assert native.attrs["fmus"] == "native"
    assert (float(native["contact_force"].min()) == 0.0) == (depth == "2e-3")


@pytest.mark.slow
def test_the_default_passage_is_that_of_the_python_fmus(folder):
    assert_same(read_scenario(None, ()), folder)


def test_the_package_runs_the_same_passage(folder, tmp_path):
    case = read_scenario(None, SHORT)
    fmus = build_for(case, "native", contact="track", directory=folder / "native")
    path = tmp_path / "short.ssp"
    ensure_package(case, fmus, path, contact="track")
    system = run_system(path, CosimOptions())
    passage = run_passage(case, fmus="native", contact="track", directory=folder / "native")
    for wheel in (1, 2):
        expected = passage["contact_force"].sel(wheel=wheel).to_numpy()
        found = system[f"track.wheel[{wheel}].contact_force"].to_numpy()
        np.testing.assert_allclose(found, expected, rtol=1e-12)
