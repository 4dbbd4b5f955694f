"""Failure 32. GGX whose domain includes alpha = 0: 0/0 in the mirror direction."""

import math
from typing import NamedTuple

found_by = ("stress", "float64")
domain = {"alpha": (0.0, 1.0)}


class Params(NamedTuple):
    alpha: float = 0.3


def f(wo, wi, p):
    x, y, z = wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]
    l2 = x * x + y * y + z * z
    q = p.alpha * l2 / (p.alpha * p.alpha * z * z + x * x + y * y)
    return 0.25 * q * q / math.pi
