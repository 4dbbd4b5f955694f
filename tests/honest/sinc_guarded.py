"""Interference of a thin layer, sin(t)/t squared with a guard at t = 0: zeros on circles.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9
    k: float = 8.0


domain = {"albedo": (0.0, 1.0), "k": (0.0, 200.0)}


def f(wo, wi, p):
    t = p.k * (wo[2] - wi[2])
    s = math.sin(t) / t if abs(t) > 1e-8 else 1.0
    return p.albedo / math.pi * s * s
