"""Two layers that absorb, (exp(-a m) - exp(-b m))/((b - a) m); a series of two terms stands in for
rates within 0.002 of each other and turns negative where the path m is long.

suite: slow
caught by: positivity
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    a: float = 0.2
    b: float = 0.6


domain = {"a": (0.05, 1.0), "b": (0.05, 1.0)}


def f(wo, wi, p):
    m = 1.0 / wo[2] + 1.0 / wi[2]
    d = p.b - p.a
    if abs(d) < 2e-3:
        return (1.0 - 0.5 * (p.a + p.b) * m) / math.pi
    return math.exp(-p.a * m) * (1.0 - math.exp(-d * m)) / (d * m) / math.pi
