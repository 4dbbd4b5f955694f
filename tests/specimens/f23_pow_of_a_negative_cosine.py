"""Failure 23. pow(r.v, n) without max(0, r.v): NaN wherever n is not whole."""

import math
from typing import NamedTuple

found_by = ("run", "positivity")
domain = {"n": (0.0, 100.0)}


class Params(NamedTuple):
    n: float = 10.5


def f(wo, wi, p):
    c = wi[2] * wo[2] - wi[0] * wo[0] - wi[1] * wo[1]
    return 0.5 * (p.n + 2.0) / (2.0 * math.pi) * math.pow(c, p.n)
