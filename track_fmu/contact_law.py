"""What a track needs to know of the contacts with its wheels, laws and surfaces not its own."""

from __future__ import annotations

from typing import Protocol

from .beam_element import FloatArray


class ContactLaw(Protocol):
    """Contact force over compression; without tension, and with a continuous tangent.

    All arrays have shape (wheels,).
    """

    def force(self, compression: FloatArray) -> FloatArray:
        """Contact force [N] at the given compression [m], zero where that is negative."""
        ...

    def stiffness(self, compression: FloatArray) -> FloatArray:
        """Derivative of the force by the compression [N/m], zero where that is negative."""
        ...

    def compression(self, force: FloatArray) -> FloatArray:
        """Compression [m] under the given force [N], at least 0."""
        ...


class Surface(Protocol):
    """What wheels and railhead lie lower than perfect ones."""

    def drops(self, positions: FloatArray) -> FloatArray:
        """Drop under every wheel [m] at given wheel positions [m], both of shape (wheels,)."""
        ...
