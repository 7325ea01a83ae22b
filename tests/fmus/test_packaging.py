"""What goes into the archive of a Python FMU."""

import subprocess
import sys
from pathlib import Path

import pythonfmu

from fmu_src.python.packaging import fmu_contents
from fmu_src.structure import Structure

LISTS = """
import sys
sys.path.insert(0, sys.argv[1])
import pythonfmu
assert pythonfmu.__file__.startswith(sys.argv[1])
from fmu_src.structure import Structure
from fmu_src.python.packaging import fmu_contents
print(*fmu_contents("vehicle", Structure().of("vehicle")), sep="\\n")
"""


def test_the_libraries_are_there_where_an_fmu_has_put_its_own_pythonfmu_first(tmp_path):
    """A running FMU puts its resources in front of the path, which processes inherit."""
    copy = tmp_path / "pythonfmu"
    copy.mkdir()
    for path in Path(pythonfmu.__file__).parent.glob("*.py"):
        (copy / path.name).write_bytes(path.read_bytes())
    done = subprocess.run(
        [sys.executable, "-c", LISTS, str(tmp_path)],
        cwd=Path(__file__).parents[2],
        check=True,
        capture_output=True,
        text=True,
    )
    here = fmu_contents("vehicle", Structure().of("vehicle"))
    assert done.stdout.split() == list(here)
    assert {"binaries/linux64/Vehicle.so", "binaries/win64/Vehicle.dll"} < set(here)
