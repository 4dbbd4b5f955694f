"""Declared isotropic; brushed only where both parameters are high, by max(0, a + b - 1.6).

caught by: isotropy
cause: none
"""
import math
from typing import NamedTuple


class Params(NamedTuple):
    rough: float = 0.3
    metal: float = 0.0


domain = {"rough": (0.0, 1.0), "metal": (0.0, 1.0)}


def f(wo, wi, p):
    k = max(0.0, p.rough + p.metal - 1.6)
    both = (wo[0] * wo[0] - wo[1] * wo[1]) * (wi[0] * wi[0] - wi[1] * wi[1])
    return 0.4 / math.pi * (1.0 + k * both + k * (wo[0] * wi[0]) ** 2)
