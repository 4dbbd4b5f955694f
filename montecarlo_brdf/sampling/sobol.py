"""Sobol points with Owen scrambling by hashing."""
from __future__ import annotations

from montecarlo_brdf.bits import GOLDEN, mix64, reverse32, u32, u64, unit
from montecarlo_brdf.sampling.keys import NONE, Point, Shape, axis_key


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
