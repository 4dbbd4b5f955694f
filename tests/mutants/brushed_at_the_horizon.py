"""Declared isotropic; a scratch along x shows where both directions are within 9 degrees of the
horizon.

suite: slow
caught by: isotropy
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 0.9)}


def f(wo, wi, p):
    deep = max(0.0, 0.15 - wo[2]) * max(0.0, 0.15 - wi[2])
    return p.albedo / math.pi * (1.0 + 4.0 * deep * (wo[0] * wi[0]) ** 2)
