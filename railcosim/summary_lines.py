"""The numbers of a passage in words and in the units an engineer expects."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from .strike import WINDOW

if TYPE_CHECKING:
    from .summary import Summary

WINDOW_CAPTION = (
    f"Forces and moments: the flat's wheel, {-WINDOW[0]:g} m before to {WINDOW[1]:g} m after the "
    "flat's centre."
)
"""Where most of the numbers look."""


class Line(NamedTuple):
    """One number: what it is, its value as a text and its unit."""

    what: str
    value: str
    unit: str


def result_lines(summary: Summary) -> list[Line]:
    """Return what the passage came to: forces, displacements and moments."""
    return [
        Line(what, "not reached" if value is None else f"{factor * value:.3f}", unit)
        for what, value, factor, unit in (
            ("largest contact force", summary.peak_contact_force, 1e-3, "kN"),
            ("  from the flat's centre", summary.peak_contact_force_position, 1e3, "mm"),
            ("smallest contact force", summary.min_contact_force, 1e-3, "kN"),
            ("time without contact", summary.loss_of_contact_time, 1e3, "ms"),
            ("largest sleeper displacement", summary.max_sleeper_displacement, 1e3, "mm"),
            (
                "largest bending moment in the struck bay",
                summary.peak_bending_moment_midspan,
                1e-3,
                "kN m",
            ),
            (
                "largest bending moment under the wheel",
                summary.peak_bending_moment_under_wheel,
                1e-3,
                "kN m",
            ),
        )
    ]


def whole_run_lines(summary: Summary) -> list[Line]:
    """Return the extremes of a run whose histories are thinned, from every step of it."""
    run = summary.whole_run
    if run is None:
        return []
    return [
        Line(
            "of any wheel, anywhere: largest contact force",
            f"{1e-3 * run.largest_contact_force:.3f}",
            "kN",
        ),
        Line("  in the stretch from", f"{run.largest_contact_force_stretch:.0f}", "m"),
        Line("  smallest contact force", f"{1e-3 * run.smallest_contact_force:.3f}", "kN"),
        Line("  time without contact", f"{1e3 * run.time_without_contact:.3f}", "ms"),
    ]


def effort_lines(summary: Summary) -> list[Line]:
    """Return what it took: steps, iterations and times."""
    rejected = {cause: n for cause, n in summary.steps.rejected.items() if n}
    causes = ", ".join(f"{n} {cause}" for cause, n in rejected.items())
    return [
        Line("accepted steps", str(summary.steps.accepted), ""),
        Line("rejected attempts", str(sum(rejected.values())), causes),
        Line("coupling iterations", str(summary.steps.iterations), ""),
        Line("simulated time", f"{summary.simulated_time:.4f}", "s"),
        Line("wall time", f"{summary.wall_time:.2f}", "s"),
    ]
