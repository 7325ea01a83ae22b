"""How pads and ballast differ from support to support."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from .beam_element import FloatArray

LEAST_MASS = 0.1
"""Of a sleeper over the nominal one; lighter ones would need shorter steps than others do."""


def nominal_value(name: str) -> float:
    """What a support has that nothing is said of, by the name of an attribute or a parameter."""
    return 0.0 if name == "gap" else 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportFactors:
    """Factors on the laws of every support, and how it is put together, (supports,) each.

    Those of an endless track are of the supports from the first one on, at one sleeper spacing,
    as far as they differ; what the model holds of them at a time is their `window`.

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
    repeat : bool
        Whether they begin anew behind the last support, without end; false: supports are nominal
        there.

    Raises
    ------
    ValueError
        For a value that is not a number of at least 0, or of at least `LEAST_MASS`, and for a
        sleeper that neither its ballast nor the rail holds.
    """

    pad_stiffness: FloatArray
    pad_damping: FloatArray
    ballast_stiffness: FloatArray
    ballast_damping: FloatArray
    gap: FloatArray
    fastened: FloatArray
    sleeper_mass: FloatArray
    repeat: bool = False

    def __post_init__(self) -> None:
        for name in self._properties():
            values = getattr(self, name)
            least = LEAST_MASS if name == "sleeper_mass" else 0.0
            wrong = np.flatnonzero(~(np.isfinite(values) & (values >= least)))
            if len(wrong):
                raise ValueError(
                    f"track: {name} = {float(values[wrong[0]])!r} of support "
                    f"{wrong[0] + 1} must be a finite number, at least {least:g}"
                )

        self._refuse_free_sleepers()

    def _refuse_free_sleepers(self) -> None:
        """Refuse what would have fallen down before the track is at rest."""
        hangs = (self.gap > 0.0) | (self.ballast_stiffness == 0.0)
        free = hangs & ((self.pad_stiffness == 0.0) | (self.fastened == 0.0))
        if not free.any():
            return
        number = int(np.argmax(free))
        below = f"a gap of {self.gap[number]:g} m" if self.gap[number] > 0.0 else "no ballast"
        padless = self.pad_stiffness[number] == 0.0
        above = "no pad ties it to the rail" if padless else "the rail is not fastened"
        raise ValueError(
            f"track: the sleeper of support {number + 1} is held by nothing: there is {below} "
            f"under it and {above}; let it rest on its ballast or hang from the rail"
        )

    @classmethod
    def nominal(cls, supports: int) -> SupportFactors:
        """All supports alike, without gaps, all fastened."""
        values: dict[str, Any] = {
            name: np.full(supports, nominal_value(name)) for name in cls._properties()
        }
        return cls(**values)

    @classmethod
    def _properties(cls) -> list[str]:
        """Names of what every support has."""
        return [field.name for field in fields(cls) if field.name != "repeat"]

    def window(self, first: int, count: int) -> SupportFactors:
        """What so many supports have, from a support on; nominal where nothing is known of them.

        Parameters
        ----------
        first : int
            Number of the first of them, from 0; below that, before the first support of the
            track, supports are nominal.
        count : int
            How many.
        """
        number, known = first + np.arange(count), len(self.gap)
        place = number % known if self.repeat else np.clip(number, 0, known - 1)
        there = (number >= 0) & (self.repeat | (number < known))
        values: dict[str, Any] = {
            name: np.where(there, getattr(self, name)[place], nominal_value(name))
            for name in self._properties()
        }
        return SupportFactors(**values)

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
