"""Sheen on a base, more than there is where both are strong; the list of verified sets is the same
set twice.

suite: slow
caught by: energy
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.5
    sheen: float = 0.1


domain = {"base": (0.0, 1.0), "sheen": (0.0, 1.0)}
verified = [Params(), Params()]


def f(wo, wi, p):
    return (p.base + p.sheen * (1.0 - wo[2]) * (1.0 - wi[2])) / math.pi
