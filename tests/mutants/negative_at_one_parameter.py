"""A weight of 1 - 3 k is negative in part of the range.

caught by: positivity
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    k: float = 0.1


domain = {"albedo": (0.0, 1.0), "k": (0.0, 0.35)}


def f(wo, wi, p):
    return p.albedo / math.pi * (1.0 - 3.0 * p.k)
