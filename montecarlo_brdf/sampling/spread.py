"""Points that fill a cube of any dimension evenly, all at once: for looking around, not for error
bars."""
from __future__ import annotations

from typing import Any


def spread(n: int, dimensions: int, key: int) -> Any:
    """(n, dimensions) numbers in [0, 1): multiples of powers of one irrational number, shifted.

    Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences".
    """
    import numpy as np

    base = 2.0
    for _ in range(60):  # the root of x^(d+1) = x + 1
        base = (1.0 + base) ** (1.0 / (dimensions + 1))
    steps = base ** -np.arange(1.0, dimensions + 1.0)
    shift = np.random.default_rng(key).random(dimensions)
    return np.mod(shift + np.arange(n)[:, None] * steps, 1.0)
