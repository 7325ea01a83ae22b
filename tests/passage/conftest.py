import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise


class Passages:
    """Runs passages of the paper's case with some keys changed, each once."""

    def __init__(self):
        self._known = {}

    def dataset(self, *overrides):
        if overrides not in self._known:
            self._known[overrides] = run_passage(read_scenario(None, overrides))
        return self._known[overrides]

    def summary(self, *overrides):
        return summarise(self.dataset(*overrides))


@pytest.fixture(scope="session")
def passages():
    return Passages()
