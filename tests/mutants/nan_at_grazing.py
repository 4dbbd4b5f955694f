"""A root that is real only above a cosine of 1e-5.

caught by: positivity
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi * math.sqrt(wi[2] - 1e-5) * math.sqrt(wo[2] - 1e-5)
