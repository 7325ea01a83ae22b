"""Hertz's law for all wheels at once."""

import numpy as np

from .contact import hertz_compression, hertz_force, hertz_stiffness
from .validation import FloatArray, require_positive


class HertzContact:
    """Contacts of the same coefficient.

    Parameters
    ----------
    coefficient : float
        C_H [N/m^1.5].

    Raises
    ------
    ValueError
        If it is not a finite number above zero.
    """

    def __init__(self, coefficient: float) -> None:
        require_positive(
            "hertz_coefficient", coefficient, "N/m^1.5", "about 9e10 for steel wheel and rail"
        )
        self._coefficient = coefficient

    def force(self, compression: FloatArray) -> FloatArray:
        """Return the contact force [N] at each compression [m], shape (wheels,)."""
        return np.array([hertz_force(d, self._coefficient) for d in compression.tolist()])

    def stiffness(self, compression: FloatArray) -> FloatArray:
        """Return the tangent stiffness [N/m] at each compression [m], shape (wheels,)."""
        return np.array(
            [
                hertz_stiffness(hertz_force(d, self._coefficient), self._coefficient)
                for d in compression.tolist()
            ]
        )

    def compression(self, force: FloatArray) -> FloatArray:
        """Return the compression [m] under each force >= 0 [N], shape (wheels,)."""
        return np.array([hertz_compression(f, self._coefficient) for f in force.tolist()])
