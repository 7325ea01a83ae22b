"""The passage as one system of equations, the way the paper solves it; no FMU takes part.

Start at `solution.solve`; `system` holds the equations.
"""

from .solution import solve

__all__ = ["solve"]
