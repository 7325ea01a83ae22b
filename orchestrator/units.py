"""Units in terms of SI base units, and the linear conversions between them."""

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from .errors import WiringError

base_units = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
"""What a unit is made of, in the order of its exponents."""


class Linear(NamedTuple):
    """The map ``factor * value + offset``.

    Attributes
    ----------
    factor, offset : float
        Both finite, the factor not zero.
    """

    factor: float = 1.0
    offset: float = 0.0

    def __call__(self, value: float) -> float:
        """Return the image of `value`."""
        return self.factor * value + self.offset

    def invert(self, value: float) -> float:
        """Return the value whose image is `value`."""
        return (value - self.offset) / self.factor

    def after(self, first: "Linear") -> "Linear":
        """Return the map that does `first` and then this one."""
        return Linear(self.factor * first.factor, self.factor * first.offset + self.offset)

    @property
    def is_sound(self) -> bool:
        """Whether it can be inverted and stays finite."""
        return isfinite(self.factor) and self.factor != 0.0 and isfinite(self.offset)


identity = Linear()


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """A unit: a value in it is ``factor * value + offset`` in SI base units.

    Attributes
    ----------
    name : str
        As written, for example ``km/h``.
    exponents : tuple of int
        Exponents of `base_units`.
    factor, offset : float
        How to get to SI base units; the factor is not zero.

    Raises
    ------
    WiringError
        For a factor or offset that is no use.
    """

    name: str
    exponents: tuple[int, ...] = (0,) * len(base_units)
    factor: float = 1.0
    offset: float = 0.0

    def __post_init__(self) -> None:
        if not Linear(self.factor, self.offset).is_sound:
            raise WiringError(
                f"unit {self.name!r}: the factor {self.factor} must be finite and not zero, the "
                f"offset {self.offset} finite."
            )

    @property
    def dimension(self) -> str:
        """The SI base units it is made of, for example ``kg.m.s-2``, or ``1``."""
        parts = [
            name if exponent == 1 else f"{name}{exponent}"
            for name, exponent in zip(base_units, self.exponents, strict=True)
            if exponent
        ]
        return ".".join(parts) or "1"


def convert(source: Unit, target: Unit) -> Linear:
    """Return how a value in one unit becomes a value in another.

    Raises
    ------
    WiringError
        When the two measure different things.
    """
    if source.exponents != target.exponents:
        raise WiringError(
            f"the units {source.name!r} ({source.dimension}) and {target.name!r} "
            f"({target.dimension}) do not measure the same thing."
        )
    return Linear(source.factor / target.factor, (source.offset - target.offset) / target.factor)
