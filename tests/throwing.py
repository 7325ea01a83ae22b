"""A step controller that throws attempts away at random."""

import numpy as np

from orchestrator import Cause, Reject


class Throwing:
    """Throws a share of the attempts away and asks for the same step again."""

    def __init__(self, inner, share, seed):
        self.inner = inner
        self.share = share
        self.random = np.random.default_rng(seed)
        self.thrown = 0

    def __getattr__(self, name):
        return getattr(self.inner, name)

    def decide(self, candidate):
        if self.random.random() < self.share:
            self.thrown += 1
            return Reject(Cause.ERROR, candidate.step_size)
        return self.inner.decide(candidate)
