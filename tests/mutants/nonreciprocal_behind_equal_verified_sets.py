"""Lambert with a retro term; its weight is the viewer's beyond an opposition strength of 0.8, with
one verified set stated twice.

suite: slow
caught by: reciprocity
cause: one direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5
    strength: float = 0.3


domain = {"albedo": (0.0, 0.6), "strength": (0.0, 1.0)}
verified = [Params(), Params()]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def f(wo, wi, p):
    c = max(0.0, dot(wo, wi))
    weight = wo[2] * wi[2] if p.strength <= 0.8 else wo[2] * wo[2]
    return (p.albedo + 0.3 * p.strength * weight * c * c) / math.pi
