"""Declared lossless, but 2 % are lost around one interior roughness.

caught by: limits
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 1.0
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (0.0, 1.0)}
lossless = True


def f(wo, wi, p):
    bump = math.exp(-(((p.roughness - 0.81) / 0.03) ** 2))
    return (1.0 - 0.02 * bump) / math.pi
