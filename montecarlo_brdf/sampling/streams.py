"""Streams: a 64-bit key from what is computed, never from the order in which it is computed.

Adding a model or skipping a check changes no other number.
"""
from __future__ import annotations

import hashlib


def stream(seed: int, *names: object) -> int:
    """The key of the stream named by `names` under a seed."""
    text = "\x1f".join(map(str, (seed, *names)))
    return int.from_bytes(hashlib.blake2b(text.encode(), digest_size=8).digest(), "little")
