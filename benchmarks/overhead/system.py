"""Two integrators in a loop, and what every algorithm must make of them."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pythonfmu.builder import FmuBuilder

STEP = 2.0**-7
"""Size of a macro step [s], which adds up without rounding; the loop has a period of 6.3 s."""

PARTNERS = {
    "left": {"gain": 0.1, "rate": 1.0, "start": 1.0},
    "right": {"gain": 0.1, "rate": -1.0, "start": 0.0},
}
"""Parameters of the two instances: dx/dt = rate * u, y = x + gain * u, u the other one's y."""

ALGORITHMS = {"jacobi": (False, False), "gauss_seidel": (False, True), "newton": (True, True)}
"""Whether left and right get the other one's output at the end of the step, or at its start."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """One run.

    Attributes
    ----------
    microseconds : float
        Wall time of a macro step, without setting up and cleaning up.
    final : tuple of float or None
        Last outputs of left and right, if they were looked at.
    iterations : float
        Steppings of each FMU in a macro step.
    """

    microseconds: float
    final: tuple[float, float] | None = None
    iterations: float = 1.0


def build_fmus(folder: Path) -> dict[str, Path]:
    """Build the integrator in C and in Python."""
    root = Path(__file__).parents[2]
    sys.path.insert(0, str(root / "tests" / "compiled"))
    from compiled_fmus import build  # noqa: PLC0415 - importable from here on only

    (folder / "python").mkdir()
    source = Path(__file__).with_name("integrator_slave.py")
    return {
        "compiled": build(folder, "Integrator", model="integrator", canInterpolateInputs=False),
        "python": FmuBuilder.build_FMU(
            source,
            dest=folder / "python",
            needsExecutionTool=False,
            canGetAndSetFMUstate=True,
            canSerializeFMUstate=True,
        ),
    }


def final_values(algorithm: str, steps: int) -> tuple[float, float]:
    """Return the outputs of left and right after so many steps with held inputs.

    A step is a linear map of both states and both outputs, so that the answer is a matrix power.
    """
    start, end = np.diag([1.0, 1.0, 0.0, 0.0]), np.eye(4)
    end[2, 0] = end[3, 1] = -1.0
    partners = tuple(PARTNERS.values())
    for own, other in ((0, 3), (1, 2)):
        side, sign = (end, -1.0) if ALGORITHMS[algorithm][own] else (start, 1.0)
        side[own, other] += sign * STEP * partners[own]["rate"]
        side[2 + own, other] += sign * partners[own]["gain"]
    first = [partner["start"] for partner in partners] * 2
    last = np.linalg.matrix_power(np.linalg.solve(end, start), steps) @ first
    return float(last[2]), float(last[3])


def largest_miss(final: tuple[float, float], algorithm: str, steps: int) -> float:
    """Return by how much `final` misses the closed form, over its largest value."""
    exact = np.array(final_values(algorithm, steps))
    return float(np.abs(np.array(final) - exact).max() / np.abs(exact).max())
