"""Minnaert, normalised, with its albedo rho mu^m; exponents above 1.2 are declared as 1.2, a limit
that f does not have.

suite: slow
caught by: furnace
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    rho: float = 0.8
    m: float = 0.7


domain = {"rho": (0.0, 1.0), "m": (0.0, 1.5)}


def f(wo, wi, p):
    return p.rho * (p.m + 2.0) / (2.0 * math.pi) * (wo[2] * wi[2]) ** p.m


def albedo(mu, p):
    return p.rho * mu ** min(p.m, 1.2)
