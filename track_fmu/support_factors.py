"""How pads and ballast differ from support to support."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from .beam_element import FloatArray

LEAST_MASS = 0.1
"""Of a sleeper over the nominal one; lighter ones would need shorter steps than others do."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportFactors:
    """Factors on the laws of every support, and how it is put together, (supports,) each.

    Attributes
    ----------
    pad_stiffness, pad_damping : float array
        Factors on the forces of spring and damper of the pad; both 0: there is no pad.
    ballast_stiffness, ballast_damping : float array
        Likewise for the ballast.
    gap : float array
        Between the unloaded sleeper and its ballast [m]; ballast under a gap cannot pull.
    fastened : float array
        1 where the fastening holds the rail down, 0 where the rail can lift off its pad.
    sleeper_mass : float array
        Factors on the mass of the sleepers.

    Raises
    ------
    ValueError
        For a value that is not a number of at least 0, or of at least `LEAST_MASS`.
    """

    pad_stiffness: FloatArray
    pad_damping: FloatArray
    ballast_stiffness: FloatArray
    ballast_damping: FloatArray
    gap: FloatArray
    fastened: FloatArray
    sleeper_mass: FloatArray

    def __post_init__(self) -> None:
        for field in fields(self):
            values = getattr(self, field.name)
            least = LEAST_MASS if field.name == "sleeper_mass" else 0.0
            wrong = np.flatnonzero(~(np.isfinite(values) & (values >= least)))
            if len(wrong):
                raise ValueError(
                    f"track: {field.name} = {float(values[wrong[0]])!r} of support "
                    f"{wrong[0] + 1} must be a finite number, at least {least:g}"
                )

    @classmethod
    def nominal(cls, supports: int) -> SupportFactors:
        """All supports alike, without gaps, all fastened."""
        return cls(
            **{
                field.name: np.full(supports, 0.0 if field.name == "gap" else 1.0)
                for field in fields(cls)
            }
        )

    @property
    def pads_differ(self) -> bool:
        """Whether any pad differs from the nominal one."""
        ones = (self.pad_stiffness, self.pad_damping, self.fastened)
        return any(bool((values != 1.0).any()) for values in ones)

    @property
    def ballast_differs(self) -> bool:
        """Whether the ballast under any sleeper differs from the nominal one."""
        ones = (self.ballast_stiffness, self.ballast_damping)
        return bool((self.gap != 0.0).any()) or any(bool((values != 1.0).any()) for values in ones)

    @property
    def sleepers_differ(self) -> bool:
        """Whether any sleeper is heavier or lighter than the nominal one."""
        return bool((self.sleeper_mass != 1.0).any())
