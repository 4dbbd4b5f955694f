"""Honest: 1 + cos(dphi) is 0 opposite the light; its rounding below 0 is divided by small cosines.
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    across = math.sqrt(wo[0] ** 2 + wo[1] ** 2) * math.sqrt(wi[0] ** 2 + wi[1] ** 2)
    c = (wo[0] * wi[0] + wo[1] * wi[1]) / across if across > 0.0 else 0.0
    return p.albedo / (4.0 * math.pi) * (1.0 + c) / (wi[2] + wo[2])
