"""Clearcoat visibility: 0/0 where both cosines are tiny.

caught by: positivity
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    a = math.floor(wi[2] * 1e6) / 1e6
    b = math.floor(wo[2] * 1e6) / 1e6
    return p.albedo / math.pi * 2.0 * a * b / (a + b)
