"""A fit that may be negative and says so; a root in it is that of a negative number where both
directions graze on one side.

suite: slow
caught by: positivity
cause: root or power of a negative
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.6


domain = {"albedo": (0.0, 1.0)}
disclaims = {"positivity": "a fit in the cosine of the angle between the directions"}


def f(wo, wi, p):
    along = wo[0] * wi[0] + wo[1] * wi[1]
    return p.albedo / math.pi * (1.1 * math.sqrt(0.9 - along) - 0.06)
