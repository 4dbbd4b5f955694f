"""What number an author meant whose float a compiler has kept: 3.14159265358979 for 3.1415927.

A float is taken as the literal of the source that rounds to it, as a simple multiple of a power of
pi, else as the shortest decimal. All of them are the same float.
"""

from __future__ import annotations

import functools
import math
import re
import struct
from collections.abc import Mapping

LITERAL = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][-+]?\d+)?")
POWERS = (math.pi, 1.0 / math.pi, math.pi**2, math.pi**-2, math.sqrt(math.pi), math.pi**-0.5)
FACTORS = (1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 23, 28, 32, 180)


def literals(text: str) -> dict[float, float]:
    """From the floats of the numbers that a text has to those with all their digits."""
    values = (float(t) for t in LITERAL.findall(text))
    return {rounded(v): v for v in values if v < 3e38}


def rounded(value: float) -> float:
    """The nearest float."""
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


@functools.cache
def multiples() -> dict[float, float]:
    """The same of multiples of powers of pi by a quotient of whole numbers."""
    quotients = {a / b for a in FACTORS for b in FACTORS}
    return {rounded(q * power): q * power for power in POWERS for q in quotients}


def meant(value: float, known: Mapping[float, float]) -> float:
    """What a float stands for."""
    size = abs(value)
    found = known.get(size) or multiples().get(size) or shortest(size)
    return math.copysign(found, value)


def shortest(value: float) -> float:
    """The number with the fewest digits that rounds to the same float."""
    for digits in range(6, 9):
        short = float(f"{value:.{digits}g}")
        if abs(short) < 3.4028235e38 and rounded(short) == value:
            return short
    return value
