"""The studies of the documentation and the example are studies, and the example runs."""

import re
from pathlib import Path

import numpy as np
import pytest

from railcosim.sweep import parse_study, read_study, run_study
from railcosim.sweep.plan import make_plan

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "sweep.toml"
DOCUMENTED = re.findall(r"```toml\n(.*?)```", (ROOT / "docs" / "sweep.md").read_text(), re.DOTALL)


@pytest.mark.parametrize("text", DOCUMENTED)
def test_a_documented_study_is_one(text):
    plan = make_plan(parse_study(text))
    assert len(plan.keys) == len(plan.study) > 1


def test_the_documented_example_is_the_example():
    text = EXAMPLE.read_text(encoding="utf-8")
    assert text.endswith(DOCUMENTED[0])
    assert len(read_study(EXAMPLE)) == 6


@pytest.mark.slow
def test_the_example_runs(client, tmp_path):
    """Linear ballast, as stiff as the unloaded one, lets a sleeper sink several times as far."""
    result = run_study(EXAMPLE, store=tmp_path / "store", client=client)
    assert result.attrs["failed_cases"] == 0
    sleeper = result["max_sleeper_displacement"]
    tracks = (sleeper.sel({"track.ballast": name}) for name in ("linear", "state_dependent"))
    linear, state_dependent = tracks
    assert (linear > 3.0 * state_dependent).all()
    assert np.isfinite(result["contact_force"]).all()
    assert result["distance"].to_numpy()[[0, -1]] == pytest.approx([-3.9, 2.6])
