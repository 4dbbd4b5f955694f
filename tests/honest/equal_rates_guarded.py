"""Two layers that absorb, (exp(-a m) - exp(-b m))/((b - a) m), by expm1 and with a guard where the
rates are equal: the branch and the formula meet.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    a: float = 0.2
    b: float = 0.6


domain = {"a": (0.0, 2.0), "b": (0.0, 2.0)}


def f(wo, wi, p):
    m = 1.0 / wo[2] + 1.0 / wi[2]
    d = abs(p.b - p.a) * m
    rest = -math.expm1(-d) / d if d > 1e-9 else 1.0 - 0.5 * d
    return math.exp(-min(p.a, p.b) * m) * rest / math.pi
