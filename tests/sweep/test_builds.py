"""FMUs that several workers need at once, and those that are one worker's own."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import fmpy
import pytest

from railcosim.builds import build_for, has_own_fmu
from railcosim.scenario_file import read_scenario
from railcosim.sweep import parse_study
from railcosim.sweep.plan import first_of_each_fmu, make_plan

BUILDERS = 4


def test_builds_of_the_same_fmu_at_once_leave_one_sound_fmu(tmp_path):
    scenario = read_scenario(None, ["track.bays=40", "flat.position=13.0"])
    together = Barrier(BUILDERS)

    def build(_):
        together.wait(timeout=60)
        paths = build_for(scenario, directory=tmp_path)
        return paths, fmpy.read_model_description(paths.track).guid

    with ThreadPoolExecutor(BUILDERS) as pool:
        built = list(pool.map(build, range(BUILDERS)))
    assert len(set(built)) == 1
    paths, _ = built[0]
    assert sorted(tmp_path.iterdir()) == sorted(
        [paths.track, paths.vehicle]
    )  # nothing half-written


@pytest.mark.parametrize(
    ("key", "fmus", "own"),
    [
        ("track.pad_stiffness=9e7", "native", True),
        ("track.pad_stiffness=9e7", "python", False),
        ("track.ballast=linear", "native", False),
        ("track.bays=60", "native", False),
    ],
)
def test_a_native_track_of_other_constants_has_an_fmu_of_its_own(key, fmus, own):
    assert has_own_fmu(read_scenario(None, [key]), fmus) is own


def test_cases_with_the_same_fmu_run_one_after_the_other():
    plan = make_plan(
        parse_study(
            "[base]\noptions.fmus = 'native'\n[sweep.grid]\nvehicle.speed_kmh = [40, 60]\n"
            "track.pad_stiffness = [8e7, 9e7]\n"
        )
    )
    assert plan.order == (0, 2, 1, 3)
    assert [case.number for case in first_of_each_fmu(plan)] == [1]  # 9e7: whoever needs it
