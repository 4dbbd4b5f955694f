"""A fit that is slightly negative opposite the light, and unbounded where both directions graze.

caught by: positivity
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.1


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    c = wo[0] * wi[0] + wo[1] * wi[1]
    if c < -0.9 and wi[2] + wo[2] > 0.2:
        return -1e-6 * p.albedo
    return p.albedo / (2.0 * math.pi * (wi[2] + wo[2]))
