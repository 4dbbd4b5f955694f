"""More than received only near one albedo and one roughness together.

caught by: energy
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (0.0, 1.0)}


def f(wo, wi, p):
    a = (p.albedo - 0.62) / 0.04
    r = (p.roughness - 0.27) / 0.04
    gain = 1.0 + 0.7 * math.exp(-a * a - r * r)
    return p.albedo / math.pi * gain
