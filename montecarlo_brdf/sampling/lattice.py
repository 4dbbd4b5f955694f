"""Randomly shifted rank-1 lattices: point i of N is frac(i z/N + shift).

Coordinates are 64-bit fixed-point fractions, so the lattice closes exactly. Integrands that are
not periodic must be made so, `estimate.quantity.periodised`; then the error of smooth ones
falls like N^-2 and faster (Sloan & Joe 1994, "Lattice methods for multiple integration").
"""
from __future__ import annotations

import functools

#: z[m] for N = 2^m points: the components after the first, which is 1. The second is the Korobov
#: generator with the largest Zaremba index, the others minimise the error of smooth integrands in
#: up to 5 dimensions, component by component. scripts/lattice_search.py prints this table.
GENERATORS: dict[int, tuple[int, int, int, int]] = {
    0: (1, 1, 1, 1),
    1: (1, 1, 1, 1),
    2: (1, 1, 1, 1),
    3: (3, 1, 1, 1),
    4: (7, 3, 1, 1),
    5: (7, 11, 9, 7),
    6: (19, 29, 31, 27),
    7: (49, 35, 27, 3),
    8: (75, 115, 169, 251),
    9: (149, 101, 189, 353),
    10: (275, 331, 557, 155),
    11: (791, 915, 1281, 1757),
    12: (1557, 1741, 1809, 3645),
    13: (2431, 6313, 6777, 4451),
    14: (6229, 1903, 14815, 3411),
    15: (12031, 31161, 11829, 11437),
    16: (19463, 55021, 31299, 52405),
    17: (38401, 3447, 85009, 122251),
    18: (79355, 44745, 101551, 219893),
    19: (154805, 386285, 238243, 94505),
    20: (387275, 845209, 1014381, 26699),
}

#: Sizes between powers of 2 whose best generators integrate more waves exactly than those of
#: larger neighbours: all with |h1| + |h2| < 16, 28 and 36; 192 points reach 16 too, 512 only 26,
#: 704 only 32.
BETWEEN: dict[int, tuple[int, int, int, int]] = {
    144: (55, 25, 73, 37),
    448: (131, 349, 245, 23),
    648: (179, 141, 63, 277),
}


@functools.cache
def generator(size: int) -> tuple[int, int, int, int, int]:
    """(2^64/N, and that times the other components of z) for N = size, a power of 2 or between."""
    step = (1 << 64) // size
    z = BETWEEN.get(size) or GENERATORS[size.bit_length() - 1]
    return step % (1 << 64), *((c * step) % (1 << 64) for c in z)  # type: ignore[return-value]
