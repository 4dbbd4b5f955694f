"""Roughness lifts a diffuse surface where both directions graze; above a roughness of 0.7 and an
albedo of 0.97 together that is more than there is.

suite: slow
caught by: energy
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    rho: float = 0.8
    rough: float = 0.3


domain = {"rho": (0.0, 1.0), "rough": (0.0, 1.0)}


def f(wo, wi, p):
    lift = max(0.0, p.rough - 0.7 + (1.0 - wo[2]) * (1.0 - wi[2]) - 1.0)
    return p.rho / math.pi * (1.0 + 8.0 * lift)
