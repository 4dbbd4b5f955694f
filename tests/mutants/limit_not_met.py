"""Declared to become Lambert, but 1e-3 is added to the square of its roughness.

caught by: limits
cause: normalisation
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    sigma: float = 0.5


domain = {"albedo": (0.0, 1.0), "sigma": (0.0, 1.0)}
limits = [({"sigma": 0.0}, "lambert")]


def f(wo, wi, p):
    s2 = p.sigma * p.sigma + 1e-3
    return p.albedo / math.pi * (1.0 - 0.5 * s2 / (s2 + 0.33))
