"""Studies: many passages that differ in some keys, run by any number of processes.

`run_study` runs a `Study`, which `read_study` reads from a file and `parse_study` from a text.
"""

from .running import SweepProgress, check_study, run_study
from .study import Study
from .study_file import parse_study, read_study

__all__ = ["Study", "SweepProgress", "check_study", "parse_study", "read_study", "run_study"]
