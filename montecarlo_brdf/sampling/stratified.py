"""Jittered grids: one point in every cell of a grid of columns and rows."""
from __future__ import annotations

from montecarlo_brdf.bits import u32, u64
from montecarlo_brdf.sampling.independent import independent_axis
from montecarlo_brdf.sampling.keys import Point, Shape, axis_key


def grid(size: int) -> Shape:
    """(size, rows, bits of rows, 0, 0) of a grid of size = 2^m cells, as square as it can be."""
    bits = (size.bit_length() - 1) // 2
    return size, 1 << bits, bits, 0, 0


def shuffled(key: int, index: int, axis: int, shape: Shape) -> int:
    """A permutation of [0, size): coordinates with different orders are independent of each other.

    Sums, products with odd numbers and shifted halves, each of which permutes words of m bits, in
    turn. (Nested scrambling would keep together what it starts from: from the highest bit the
    halves of all coordinates, and their quarters, and so on; from the lowest bit the rows.)
    """
    random = axis_key(key, u64(16) + axis)
    last, half = u32(u64(shape[0]) - u64(1)), u32(u64(shape[2]) + u64(1))
    x = stirred(u32(index), u32(random), u32(random >> u64(8)) | u32(1), last, half)
    x = stirred(x, u32(random >> u64(32)), u32(0x85EBCA6B), last, half)
    x = stirred(x, u32(random >> u64(16)), u32(0xC2B2AE35), last, half)
    return u64(stirred(x, u32(random >> u64(24)), u32(0x27D4EB2F), last, half))


def stirred(x: int, add: int, odd: int, last: int, half: int) -> int:
    """One turn on words of m bits, of which `last` has all: low bits change high ones by the
    product, high bits low ones by the shift of more than m/2."""
    x = u32(u32(x + add) * odd) & last
    return x ^ (x >> half)


def column(key: int, index: int, cell: int, axis: int, shape: Shape) -> float:
    """First coordinate of a cell of the grid."""
    place = u64(u64(cell) >> u64(shape[2]))
    return (place + independent_axis(key, index, axis)) * (u64(shape[1]) / u64(shape[0]))


def row(key: int, index: int, cell: int, axis: int, shape: Shape) -> float:
    """Second coordinate of a cell of the grid."""
    place = u64(u64(cell) & u64(u64(shape[1]) - u64(1)))
    return (place + independent_axis(key, index, axis)) * (1.0 / u64(shape[1]))


def stratified(key: int, index: int, shape: Shape) -> Point:
    """Coordinates (0, 1) and (2, 3) on jittered grids, 4 in strata, in independent orders."""
    i2 = shuffled(key, index, u64(2), shape)
    i4 = shuffled(key, index, u64(4), shape)
    return (
        column(key, index, index, u64(0), shape),
        row(key, index, index, u64(1), shape),
        column(key, index, i2, u64(2), shape),
        row(key, index, i2, u64(3), shape),
        (i4 + independent_axis(key, index, u64(4))) * (1.0 / u64(shape[0])),
    )
