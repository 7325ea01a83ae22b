import pytest
from numpy.linalg import LinAlgError

from railcosim import builds
from railcosim.errors import RunError
from railcosim.scenario import Scenario
from track_fmu.eigensolver import EigenvalueError


@pytest.mark.parametrize("error", [EigenvalueError("no mode"), LinAlgError("no mode")])
def test_modes_that_are_not_found_are_said_in_a_sentence(monkeypatch, tmp_path, error):
    def refuse(*_, **__):
        raise error

    monkeypatch.setattr(builds, "ensure_native_fmus", refuse)
    with pytest.raises(RunError, match=r"cannot be found \(no mode\); check the keys of \[track\]"):
        builds.build_for(Scenario(), "native", directory=tmp_path)
