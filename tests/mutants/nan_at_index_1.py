"""0/0 where the index of refraction is 1, inside its range.

caught by: positivity
cause: not finite
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    ior: float = 1.5


domain = {"albedo": (0.0, 1.0), "ior": (0.5, 2.5)}


def f(wo, wi, p):
    r0 = ((p.ior - 1.0) / (p.ior + 1.0)) ** 2
    g = (1.0 - r0) * (p.ior - 1.0) / (p.ior - 1.0)
    return p.albedo / math.pi * g
