"""Interference of a thin layer, sin(t)/t squared of the difference of the cosines: 0/0 where they
are equal, the mirror direction among them.

suite: slow
caught by: positivity
cause: not finite
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9
    k: float = 8.0


domain = {"albedo": (0.0, 1.0), "k": (0.5, 30.0)}


def f(wo, wi, p):
    t = p.k * (wo[2] - wi[2])
    return p.albedo / math.pi * (math.sin(t) / t) ** 2
