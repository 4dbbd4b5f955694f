"""Point sets: uniform numbers in [0, 1)^5 from a 64-bit key and an index, with no state.

A point depends on nothing but (key, index, shape of the set): any order, any number of threads,
the same numbers. A key stands for one randomisation; replicates use different keys. Coordinates
that a kernel does not use cost nothing: the compiler removes them.
"""
from __future__ import annotations

import hashlib
from collections.abc import Callable
from enum import StrEnum

from montecarlo_brdf.bits import GOLDEN, LOW, mix64, reverse32, u32, u64, unit
from montecarlo_brdf.sampling.lattice import GENERATORS, generator

DIMENSIONS = 5
Point = tuple[float, float, float, float, float]
#: what a point set must know beforehand: its size and four words of its own
Shape = tuple[int, int, int, int, int]
NONE: Shape = (0, 0, 0, 0, 0)

# keys, from which every coordinate is hashed ------------------------------------------------------


def stream(seed: int, *names: object) -> int:
    """The key of the stream named by `names` under a seed: by what is computed, never by the order
    in which it is. Adding a model or skipping a check changes no other number."""
    text = "\x1f".join(map(str, (seed, *names)))
    return int.from_bytes(hashlib.blake2b(text.encode(), digest_size=8).digest(), "little")


def replicate_key(key: int, replicate: int) -> int:
    """The key of one randomisation out of many that share a stream."""
    return mix64(u64(u64(key) ^ mix64(u64(u64(replicate) * u64(GOLDEN) + u64(1)))))


def axis_key(key: int, axis: int) -> int:
    """The key of one coordinate."""
    return mix64(u64(key + axis * u64(0xD1342543DE82EF95) + u64(0x632BE59BD9B4E019)))


# independent points -------------------------------------------------------------------------------

#: A Feistel network makes of a counter the words of two coordinates: the first after five rounds,
#: the second after two more. A round needs one product of 32-bit words, of which a processor makes
#: four or eight at a time; SplitMix64's 64-bit products, put together from three each, took half
#: the time of a simple kernel. All 52 bits of a coordinate count: samplers cut one number into two.
#: Source: Salmon, Moraes, Dror, Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3",
#: Philox2x32. There a key changes in every round; here it is where the counter starts. How many
#: rounds are needed was measured: scripts/results/practrand.md.
MULTIPLIER = 0xD256D193


def crossed(left: int, right: int) -> tuple[int, int]:
    """A round: the halves of right times a constant change places, and the one that becomes right
    takes up left. Only the lower 32 bits of both words count: to clear the others would cost."""
    product = u64(u64(right & u64(LOW)) * u64(MULTIPLIER))
    return product, (product >> u64(32)) ^ left


def joined(left: int, right: int) -> int:
    """The 64 bits of both halves."""
    return u64(left << u64(32)) | (right & u64(LOW))


def words(key: int, index: int, pair: int) -> tuple[int, int]:
    """The words of coordinates 2 pair and 2 pair + 1."""
    z = u64(axis_key(key, pair) + u64(index))
    left, right = z >> u64(32), z
    left, right = crossed(left, right)
    left, right = crossed(left, right)
    left, right = crossed(left, right)
    left, right = crossed(left, right)
    left, right = crossed(left, right)
    first = joined(left, right)
    left, right = crossed(left, right)
    left, right = crossed(left, right)
    return first, joined(left, right)


def independent_axis(key: int, index: int, axis: int) -> float:
    """One coordinate."""
    first, second = words(key, index, u64(axis) >> u64(1))
    return unit(second if u64(axis) & u64(1) else first)


def independent(key: int, index: int, shape: Shape = NONE) -> Point:
    """Independent uniform points; resolution 2^-52, period 2^64 per key and pair of coordinates."""
    return (
        independent_axis(key, index, u64(0)),
        independent_axis(key, index, u64(1)),
        independent_axis(key, index, u64(2)),
        independent_axis(key, index, u64(3)),
        independent_axis(key, index, u64(4)),
    )


# jittered grids: one point in every cell of a grid of columns and rows ----------------------------


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


# Sobol's points with Owen scrambling by hashing ---------------------------------------------------


def owen_reversed(x: int, seed: int) -> int:
    """Nested uniform (Owen) scrambling of a word whose first digit is its lowest bit.

    Each bit is flipped depending on the bits below it only. Source: Laine & Karras 2011, EGSR;
    constants by Vegdahl 2021, "Building a better LK hash".
    """
    x = x ^ u32(x * u32(0x3D20ADEA))
    x = u32(x + seed)
    x = u32(x * ((seed >> u32(16)) | u32(1)))
    x = x ^ u32(x * u32(0x05526C56))
    return x ^ u32(x * u32(0x53A22864))


def pascal_reversed(x: int) -> int:
    """Second Sobol coordinate of index x, first digit in the lowest bit.

    Multiplication by the Pascal matrix modulo 2 (right shifts, because digits are reversed; left
    shifts give right marginals and a wrong net). Source: Ahmed 2024, "An implementation algorithm
    of 2D Sobol sequence fast, elegant, and compact", EGSR.
    """
    x = x ^ (x >> u32(16))
    x = x ^ ((x >> u32(8)) & u32(0x00FF00FF))
    x = x ^ ((x >> u32(4)) & u32(0x0F0F0F0F))
    x = x ^ ((x >> u32(2)) & u32(0x33333333))
    return x ^ ((x >> u32(1)) & u32(0x55555555))


def scrambled(word: int, key: int, index: int, axis: int) -> float:
    """A scrambled coordinate; the digits below 2^-32 are random, as in full Owen scrambling."""
    seed = axis_key(key, axis)
    digits = reverse32(u32(owen_reversed(word, u32(seed >> u64(32)))))
    below = mix64(u64(seed + u64(index) * u64(GOLDEN))) >> u64(32)
    return unit((u64(digits) << u64(32)) | below)


def sobol_shuffled(key: int, index: int, axis: int) -> int:
    """The index in an Owen-shuffled order: pairs of coordinates that use different orders are
    independent of each other, and each stays a (0, 2)-sequence (Burley 2020, JCGT 9(4))."""
    seed = u32(axis_key(key, u64(16) + axis) >> u64(32))
    return u32(reverse32(u32(owen_reversed(u32(reverse32(u32(index))), seed))))


def third(index: int) -> int:
    """The third Sobol coordinate of an index, its first digit in the highest bit.

    Primitive polynomial x^2 + x + 1, initial numbers 1 and 3 (Joe & Kuo 2008, table for d = 3):
    V_k = V_{k-1} ^ V_{k-2} ^ (V_{k-2} >> 2). The loop is unrolled to constants when compiled.
    """
    before, last = u32(0x80000000), u32(0xC0000000)
    word = u32(0)
    for j in range(32):
        word = u32(word ^ (before * ((index >> u32(j)) & u32(1))))
        before, last = last, u32(last ^ before ^ (before >> u32(2)))
    return word


def sobol(key: int, index: int, shape: Shape = NONE) -> Point:
    """Sobol points, Owen-scrambled by hashing; coordinates (0, 1) and (2, 3) are (0, 2)-nets.

    Coordinate 4 is the third of the sequence that 0 and 1 belong to: a sampler that chooses its
    lobe by it keeps the directions of every lobe well spread.
    """
    i0 = u32(index)
    i2 = sobol_shuffled(key, index, u64(2))
    return (
        scrambled(i0, key, index, u64(0)),
        scrambled(u32(pascal_reversed(i0)), key, index, u64(1)),
        scrambled(i2, key, index, u64(2)),
        scrambled(u32(pascal_reversed(i2)), key, index, u64(3)),
        scrambled(u32(reverse32(third(i0))), key, index, u64(4)),
    )


def sobol_pair(key: int, index: int, shape: Shape = NONE) -> Point:
    """The coordinates 0 and 1 of `sobol`: what most samplers use, and quick to compile."""
    i0 = u32(index)
    return (
        scrambled(i0, key, index, u64(0)),
        scrambled(u32(pascal_reversed(i0)), key, index, u64(1)),
        0.0,
        0.0,
        0.0,
    )


def sobol_plane(key: int, index: int, shape: Shape = NONE) -> Point:
    """The coordinates 0, 1 and 4 of `sobol`, for integrands over one direction: half to compile."""
    i0 = u32(index)
    return (
        scrambled(i0, key, index, u64(0)),
        scrambled(u32(pascal_reversed(i0)), key, index, u64(1)),
        0.0,
        0.0,
        scrambled(u32(reverse32(third(i0))), key, index, u64(4)),
    )


# lattices with a random shift ---------------------------------------------------------------------


def lattice_axis(key: int, index: int, axis: int, step: int) -> float:
    """One coordinate; the shift has the full 64 bits of its key.

    An index is less than 2^32: told so, the compiler leaves a third of the product out.
    """
    return unit(u64(u64(u64(index & u64(LOW)) * u64(step)) + axis_key(key, axis)))


def lattice(key: int, index: int, shape: Shape) -> Point:
    """Points of a randomly shifted lattice."""
    return (
        lattice_axis(key, index, u64(0), shape[0]),
        lattice_axis(key, index, u64(1), shape[1]),
        lattice_axis(key, index, u64(2), shape[2]),
        lattice_axis(key, index, u64(3), shape[3]),
        lattice_axis(key, index, u64(4), shape[4]),
    )


class PointSet(StrEnum):
    """How the points of one randomisation lie: each has a function of its name here."""

    INDEPENDENT = "independent"
    STRATIFIED = "stratified"
    SOBOL = "sobol"
    LATTICE = "lattice"


#: largest number of points per replicate, and whether it must be a power of two
SETS: dict[str, tuple[int, bool]] = {
    PointSet.INDEPENDENT: (1 << 62, False),
    PointSet.STRATIFIED: (1 << 32, True),
    PointSet.SOBOL: (1 << 32, True),
    PointSet.LATTICE: (1 << max(GENERATORS, default=0), True),
}
#: what must be known of a set before its points: from its number of points
SHAPES: dict[str, Callable[[int], Shape]] = {
    PointSet.STRATIFIED: grid,
    PointSet.LATTICE: generator,
}


def counted(key: int, index: int, shape: Shape = NONE) -> Point:
    """No points but the index itself: for integrands that look at chosen directions."""
    return 1.0 * index, 0.0, 0.0, 0.0, 0.0
