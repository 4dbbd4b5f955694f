"""Independent uniform points by a hash of a counter."""
from __future__ import annotations

from montecarlo_brdf.bits import GOLDEN, mix64, u64, unit
from montecarlo_brdf.sampling.keys import NONE, Point, Shape, axis_key


def independent_axis(key: int, index: int, axis: int) -> float:
    """SplitMix64 used as a function of its counter: word = mix(axis key + index * golden)."""
    return unit(mix64(u64(axis_key(key, axis) + u64(index) * u64(GOLDEN))))


def independent(key: int, index: int, shape: Shape = NONE) -> Point:
    """Independent uniform points; resolution 2^-52, period 2^64 per key and coordinate."""
    return (
        independent_axis(key, index, u64(0)),
        independent_axis(key, index, u64(1)),
        independent_axis(key, index, u64(2)),
        independent_axis(key, index, u64(3)),
        independent_axis(key, index, u64(4)),
    )
