"""Parameters of the supports of a scenario: its table and its variation, multiplied together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from fmu_src.python.supports import PROPERTIES, make_factors, read_columns

from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .scenario import Scenario
    from .track_section import Track
    from .variation import Variation

PAD_STREAM, BALLAST_STREAM, SLEEPER_STREAM = 0, 1, 2
"""Which random numbers of a seed are whose."""


def support_values(scenario: Scenario) -> dict[str, float | bool]:
    """Return the parameters ``support[i].*`` of an ordinary track's FMU that are not nominal.

    Raises
    ------
    InputError
        For a table that cannot be used.
    """
    return {
        f"support[{i + 1}].{name}": bool(value) if name == "fastened" else float(value)
        for name, values in support_properties(scenario).items()
        for i, value in enumerate(values)
        if value != PROPERTIES[name]
    }


def support_properties(scenario: Scenario) -> dict[str, NDArray[np.float64]]:
    """Return what all supports have, by the names of `PROPERTIES`, shape (supports,) each.

    Of an endless track those that the passage reaches, from the first one of the track on: a
    support has the same properties however many there are.

    Raises
    ------
    InputError
        For a table that cannot be used, or a sleeper that nothing holds.
    """
    track, variation, supports = scenario.track, scenario.variation, scenario.supports
    values = _table_values(track, supports)
    positions = np.array([track.sleeper_spacing * (i + 1) for i in range(supports)])
    factors = {
        "pad": random_factors(variation, positions, variation.pad_stiffness_deviation, PAD_STREAM),
        "ballast": random_factors(
            variation, positions, variation.ballast_stiffness_deviation, BALLAST_STREAM
        )
        * transition_factors(variation, positions),
    }
    for part, factor in factors.items():
        values[f"{part}_stiffness_factor"] *= factor
        values[f"{part}_damping_factor"] *= factor
    values["sleeper_mass_factor"] *= random_factors(
        variation, positions, variation.sleeper_mass_deviation, SLEEPER_STREAM
    )
    values["gap"][variation.listed("hanging_sleepers", supports)] = variation.hanging_gap
    values["fastened"][variation.listed("missing_fastenings", supports)] = 0.0
    for name in ("pad_stiffness_factor", "pad_damping_factor"):
        values[name][variation.listed("missing_pads", supports)] = 0.0
    try:
        make_factors(values)
    except ValueError as error:
        raise InputError(str(error)) from error
    return values


def _table_values(track: Track, supports: int) -> dict[str, NDArray[np.float64]]:
    """What the table of a track says of so many supports."""
    if not track.supports:
        return {name: np.full(supports, nominal) for name, nominal in PROPERTIES.items()}
    most = None if track.endless else supports
    try:
        columns = read_columns(track.supports, spacing=track.sleeper_spacing, supports=most)
        factors = make_factors(columns, repeat=track.supports_repeat).window(0, supports)
    except ValueError as error:
        raise InputError(str(error)) from error
    return {name: getattr(factors, name.removesuffix("_factor")) for name in PROPERTIES}


def random_factors(
    variation: Variation, positions: NDArray[np.float64], deviation: float, stream: int
) -> NDArray[np.float64]:
    """Log-normal factors of median 1 whose logarithm is correlated exponentially along the track.

    Parameters
    ----------
    variation : Variation
        Its seed and its correlation length.
    positions : (supports,) float array
        Equidistant [m].
    deviation : float
        Standard deviation of the logarithm.
    stream : int
        Which random numbers of the seed are used.
    """
    if deviation == 0.0:
        return np.ones(len(positions))
    normal = np.random.default_rng([variation.seed, stream]).standard_normal(len(positions))
    spacing, length = positions[0], variation.correlation_length
    likeness = np.exp(-spacing / length) if length > 0.0 else 0.0
    for i in range(1, len(normal)):
        normal[i] = likeness * normal[i - 1] + np.sqrt(1.0 - likeness**2) * normal[i]
    return np.asarray(np.exp(deviation * normal))


def transition_factors(variation: Variation, positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Factors from 1 to that behind the transition, their logarithm on a straight line."""
    beyond = positions - variation.transition_begin
    length = variation.transition_length
    share = np.clip(beyond / length, 0.0, 1.0) if length > 0.0 else (beyond > 0.0).astype(float)
    return np.asarray(variation.transition_factor**share)
