"""Independent uniform points by a hash of a counter.

A Feistel network makes of a counter the words of two coordinates: the first after five rounds, the
second after two more. A round needs one product of 32-bit words, of which a processor makes four or
eight at a time; SplitMix64's 64-bit products, put together from three each, took half the time of a
simple kernel. All 52 bits of a coordinate count: samplers cut one number into two.
Source: Salmon, Moraes, Dror, Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3", Philox2x32.
There a key changes in every round; here it is where the counter starts. How many rounds are needed
was measured: scripts/results/practrand.md.
"""
from __future__ import annotations

from montecarlo_brdf.bits import LOW, u64, unit
from montecarlo_brdf.sampling.keys import NONE, Point, Shape, axis_key

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
