"""Failure 31. alpha^2 of a small alpha is 0 in half precision: 0/0 in Smith's G."""

import math
from typing import NamedTuple

found_by = ("stress", "float16")
domain = {"alpha": (1e-3, 1.0)}


class Params(NamedTuple):
    alpha: float = 0.0016


def smith(c, a2):
    return a2 / (a2 * (c + math.sqrt(a2 + (1.0 - a2) * c * c)))


def f(wo, wi, p):
    a2 = p.alpha * p.alpha
    return 0.25 * smith(wi[2], a2) * smith(wo[2], a2) / math.pi
