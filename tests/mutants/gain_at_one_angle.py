"""Reflects too much only within about two degrees around 40.

caught by: energy
cause: angle
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    a = math.exp(-(((math.acos(min(1.0, wo[2])) - 0.7) / 0.03) ** 2))
    b = math.exp(-(((math.acos(min(1.0, wi[2])) - 0.7) / 0.03) ** 2))
    return 0.97 * p.albedo / math.pi * (1.0 + 0.06 * (a + b))
