"""Brushed metal by y/x, which is inf/inf where x is exactly 0.

caught by: positivity
cause: not finite
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


isotropic = False


def c2(w):
    if w[0] == 0.0 and w[1] == 0.0:
        return 0.0
    t = w[1] / w[0]
    return (1.0 - t * t) / (1.0 + t * t)


def f(wo, wi, p):
    return p.albedo / math.pi * (1.0 + 0.2 * c2(wo) * c2(wi))
