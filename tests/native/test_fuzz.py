"""Random calls, short; the script beside it takes any number of them."""

import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.native.model_sources import MODELS

SCRIPT = Path(__file__).with_name("fuzz_calls.py")
CALLS = 5_000


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("model", MODELS)
def test_no_call_crashes(unpacked, tmp_path, version, model):
    """All three answers come, so that the calls reach what is behind the checks."""
    command = [sys.executable, SCRIPT, unpacked[version, model], "1", str(CALLS)]
    done = subprocess.run(
        command, cwd=tmp_path, check=False, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert all(int(count) > CALLS // 100 for count in done.stdout.split())
