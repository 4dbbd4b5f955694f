"""Points in arrays, all at once, for searches: to look around in, and as nodes of means without
error bars."""
from __future__ import annotations

import functools
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


@functools.lru_cache(maxsize=16)
def net(n: int, key: int) -> Any:
    """The first n points (n, 3) of Sobol's sequence under a random digital shift: nodes of means.

    Direction numbers of the polynomials 1, x + 1 and x^2 + x + 1. Source: Joe & Kuo 2008.
    """
    import numpy as np

    index = np.arange(n, dtype=np.uint32)
    shift = np.random.default_rng(key).integers(0, 1 << 32, 3, dtype=np.uint32)
    points = np.tile(shift, (n, 1))
    for axis, column in enumerate(_directions()):
        for bit in range(max(1, (n - 1).bit_length())):
            points[:, axis] ^= ((index >> np.uint32(bit)) & np.uint32(1)) * np.uint32(column[bit])
    return (points + 0.5) / 2.0**32


def _directions() -> list[list[int]]:
    first = [1 << (31 - k) for k in range(32)]
    second, third = [1 << 31], [1 << 31, 3 << 30]
    for k in range(1, 32):
        second.append(second[k - 1] ^ (second[k - 1] >> 1))
    for k in range(2, 32):
        third.append(third[k - 2] ^ (third[k - 2] >> 2) ^ third[k - 1])
    return [first, second, third]
