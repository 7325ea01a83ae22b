"""Measurements made from a known track, with seeded noise."""

import numpy as np

from railcosim.receptance.measured import MeasuredReceptance
from railcosim.receptance.study import ReceptanceStudy, midspan
from railcosim.scenario import Scenario
from railcosim.track_section import Track

TRUE = {
    "pad_stiffness": 80e6,
    "pad_damping": 15e3,
    "ballast_stiffness": 30e6,
    "ballast_damping": 31e3,
}
"""Table 1 of the paper."""


def started(*factors):
    """The track of Table 1 with its support parameters multiplied."""
    values = zip(TRUE.items(), factors, strict=True)
    return Scenario(track=Track(**{name: value * factor for (name, value), factor in values}))


def noisy(frequency, *, noise, seed, phase=True, response=None):
    """Receptance of Table 1, real and imaginary part of its logarithm off by `noise`."""
    scenario, random = Scenario(), np.random.default_rng(seed)
    load = midspan(scenario)
    study = ReceptanceStudy(scenario=scenario, load=load, response=response or load)
    errors = random.normal(size=(2, frequency.size))
    value = study.receptance(frequency) * np.exp(noise * (errors[0] + 1j * errors[1]))
    return MeasuredReceptance(
        frequency=frequency,
        amplitude=np.abs(value),
        phase=np.rad2deg(np.angle(value)) if phase else None,
    )
