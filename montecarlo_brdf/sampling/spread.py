"""Points in arrays, all at once, for searches: to look around in, and as nodes of means without
error bars."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from montecarlo_brdf.bits import reverse32
from montecarlo_brdf.sampling.points import pascal_reversed, third

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


def spread(n: int, dimensions: int, key: int) -> npt.NDArray[np.float64]:
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
def net(n: int, key: int) -> npt.NDArray[np.float64]:
    """The first n points (n, 3) of Sobol's sequence under a random digital shift, as nodes."""
    import numpy as np

    index = np.arange(n, dtype=np.uint32)
    shift = np.random.default_rng(key).integers(0, 1 << 32, 3, dtype=np.uint32)
    points = np.tile(shift, (n, 1))
    for axis, column in enumerate(_directions()):
        for bit in range(max(1, (n - 1).bit_length())):
            points[:, axis] ^= ((index >> np.uint32(bit)) & np.uint32(1)) * np.uint32(column[bit])
    return (points + np.float64(0.5)) / 2.0**32


@functools.cache
def _directions() -> list[list[int]]:
    """The words of the points 1, 2, 4, ... in each coordinate; all others are sums of these."""
    powers = [1 << k for k in range(32)]
    return [
        [reverse32(word) for word in powers],
        [reverse32(pascal_reversed(word)) for word in powers],
        [third(word) for word in powers],
    ]
