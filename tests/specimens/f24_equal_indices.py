"""Failure 24. Fresnel by angles, sin(a - b)/sin(a + b): 0/0 at the normal and for eta = 1."""

import math
from typing import NamedTuple

found_by = ("run", "positivity")
domain = {"eta": (1.0, 3.0)}


class Params(NamedTuple):
    eta: float = 1.5


def f(wo, wi, p):
    s_i, s_o = math.sqrt(wi[0] ** 2 + wi[1] ** 2), math.sqrt(wo[0] ** 2 + wo[1] ** 2)
    a = math.asin(min(1.0, 0.5 * (s_i + s_o)))
    b = math.asin(math.sin(a) / p.eta)
    return (math.sin(a - b) / math.sin(a + b)) ** 2 / math.pi
