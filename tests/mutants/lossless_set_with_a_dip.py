"""Declared lossless at k = 1, which it is but for viewers and lights about 40 degrees.

suite: slow
caught by: limits
cause: angle
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    k: float = 0.2


domain = {"k": (0.0, 1.0)}
lossless = [Params(k=1.0)]


def dip(mu):
    return math.exp(-(((mu - 0.77) / 0.04) ** 2))


def f(wo, wi, p):
    return (0.5 + 0.5 * p.k - 0.2 * dip(wo[2]) * dip(wi[2]) * p.k) / math.pi
