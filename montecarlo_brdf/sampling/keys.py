"""Keys: the 64-bit words that stand for randomisations, from which every coordinate is hashed.

A stream's key is made from what is computed, never from the order in which it is computed: adding a
model or skipping a check changes no other number.
"""
from __future__ import annotations

import hashlib

from montecarlo_brdf.bits import GOLDEN, mix64, u64

Point = tuple[float, float, float, float, float]
#: what a point set must know beforehand: its size and four words of its own
Shape = tuple[int, int, int, int, int]
NONE: Shape = (0, 0, 0, 0, 0)


def replicate_key(key: int, replicate: int) -> int:
    """The key of one randomisation out of many that share a stream."""
    return mix64(u64(u64(key) ^ mix64(u64(u64(replicate) * u64(GOLDEN) + u64(1)))))


def axis_key(key: int, axis: int) -> int:
    """The key of one coordinate."""
    return mix64(u64(key + axis * u64(0xD1342543DE82EF95) + u64(0x632BE59BD9B4E019)))


def stream(seed: int, *names: object) -> int:
    """The key of the stream named by `names` under a seed."""
    text = "\x1f".join(map(str, (seed, *names)))
    return int.from_bytes(hashlib.blake2b(text.encode(), digest_size=8).digest(), "little")
