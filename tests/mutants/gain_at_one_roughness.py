"""Energy gain of 1 % around one interior value of a parameter.

caught by: energy
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 1.0
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (0.0, 1.0)}


def f(wo, wi, p):
    bump = math.exp(-(((p.roughness - 0.62) / 0.02) ** 2))
    return p.albedo / math.pi * (1.0 + 0.01 * bump)
