"""Matrices put together of parts, all dense or all sparse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .linear_track import Matrix


@dataclass(frozen=True, slots=True, kw_only=True)
class Blocks:
    """How matrices of one kind are made.

    Attributes
    ----------
    matrix : callable
        Turns an array of either kind into this kind.
    stack, beside : callable
        Put some above and beside each other.
    zeros : callable
        Makes one of given numbers of rows and columns without entries.
    """

    matrix: Callable[[Matrix], Matrix]
    stack: Callable[[Sequence[Matrix]], Matrix]
    beside: Callable[[Sequence[Matrix]], Matrix]
    zeros: Callable[[int, int], Matrix]


DENSE = Blocks(
    matrix=np.asarray,
    stack=np.vstack,
    beside=np.hstack,
    zeros=lambda rows, columns: np.zeros((rows, columns)),
)
SPARSE = Blocks(
    matrix=sp.csr_array,
    stack=lambda parts: sp.csr_array(sp.vstack(parts)),
    beside=lambda parts: sp.csr_array(sp.hstack(parts)),
    zeros=lambda rows, columns: sp.csr_array((rows, columns)),
)
