"""Negative only near one k and one m together.

caught by: positivity
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5
    k: float = 0.5
    m: float = 0.5


domain = {"albedo": (0.0, 1.0), "k": (0.0, 1.0), "m": (0.0, 1.0)}


def f(wo, wi, p):
    a, b = (p.k - 0.7) / 0.03, (p.m - 0.2) / 0.03
    return p.albedo / math.pi * (1.0 - 1.2 * math.exp(-a * a - b * b))
