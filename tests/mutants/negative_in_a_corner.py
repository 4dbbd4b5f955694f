"""A fitted polynomial turns negative where both directions graze on opposite sides.

caught by: positivity
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    c = wo[0] * wi[0] + wo[1] * wi[1]
    return p.albedo / math.pi * (0.97 + min(0.0, c + 0.0) ** 3)
