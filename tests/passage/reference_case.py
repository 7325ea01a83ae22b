"""The paper's case: what the tests of the passage share."""

SPEED = 40.0 / 3.6
"""Speed of the vehicle [m/s]."""

STATIC_LOAD = 117_720.0
"""Contact force of a wheel at rest [N]."""

NEAR = ("run.approach=1.5", "run.departure=0.9")
"""The strike and what its figures are taken from, at a third of the cost of a whole run."""
