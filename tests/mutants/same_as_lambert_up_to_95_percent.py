"""Declared to be lambert; albedos beyond 0.95 are taken for mistakes and reduced.

suite: slow
caught by: equality
cause: clipped
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
same_as = "lambert"


def f(wo, wi, p):
    return min(p.albedo, 0.95) / math.pi
