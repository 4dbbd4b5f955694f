"""Blending base colours and lobes gains energy only between the ends.

caught by: energy
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9
    metallic: float = 0.0


domain = {"albedo": (0.0, 1.0), "metallic": (0.0, 1.0)}


def f(wo, wi, p):
    blended = 1.0 + 0.2 * p.metallic * (1.0 - p.metallic)
    return p.albedo / math.pi * blended
