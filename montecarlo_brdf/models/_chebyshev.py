"""Chebyshev series with coefficients in tuples of eight, which a compiler can unroll.

An index that is not a literal makes numba choose among all items of a tuple at run time; literal
indices of short tuples cost nothing, and the loop over samples still vectorises.
"""
from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]

Eight = tuple[float, ...]


def eight_terms(k: Eight, t: float, b: float, c: float) -> tuple[float, float]:
    """Eight steps of Clenshaw's recurrence, from the highest term down."""
    d = 2.0 * t
    c = k[7] + d * b - c
    b = k[6] + d * c - b
    c = k[5] + d * b - c
    b = k[4] + d * c - b
    c = k[3] + d * b - c
    b = k[2] + d * c - b
    c = k[1] + d * b - c
    b = k[0] + d * c - b
    return b, c


def fitted(function: Callable[[Array], Array], terms: int) -> tuple[Eight, ...]:
    """The series that agrees with `function`, of arrays, at Chebyshev's points in [-1, 1], in
    eights."""
    import numpy as np

    series = np.polynomial.chebyshev.chebinterpolate(function, terms - 1)  # type: ignore[type-var]
    return tuple(tuple(map(float, row)) for row in series.reshape(-1, 8))
