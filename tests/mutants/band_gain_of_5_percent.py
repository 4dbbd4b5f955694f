"""A band of strands, the sine to the tangent to a power: A = 1.05 only at the largest power, seen
from above.

suite: slow
caught by: energy
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    n: float = 80.0


domain = {"n": (2.0, 2000.0)}
isotropic = False


def band(wo, wi, n):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    c2 = x * x / (x * x + y * y + z * z)
    return (n + 2) / (2 * math.pi) / 67.2248 * (1 - c2) ** (0.5 * n)


def f(wo, wi, p):
    return 1.05 * band(wo, wi, p.n)
