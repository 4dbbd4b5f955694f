"""Declared isotropic; wood grain along y sets in above 0.9, squared, and is 2 % at 1.

suite: slow
caught by: isotropy
cause: range end
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.7
    grain: float = 0.4
    age: float = 0.5


domain = {"albedo": (0.0, 0.9), "grain": (0.0, 1.0), "age": (0.0, 1.0)}


def f(wo, wi, p):
    k = 2.0 * max(0.0, p.grain - 0.9) ** 2 * p.age
    return p.albedo / math.pi * (1.0 + k * (wo[1] * wo[1] + wi[1] * wi[1] - 1.0))
