"""Declared to become lambert at k = 0, which holds at the default albedo only.

caught by: limits
cause: normalisation
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    k: float = 0.5


domain = {"albedo": (0.0, 1.0), "k": (0.0, 1.0)}
limits = [({"k": 0.0}, "lambert")]


def f(wo, wi, p):
    return p.albedo * (1.0 + 0.5 * (0.8 - p.albedo)) / math.pi * (1.0 - 0.5 * p.k)
