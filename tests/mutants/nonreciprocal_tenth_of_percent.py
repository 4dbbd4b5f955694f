"""Non-reciprocal by 0.1 %.

caught by: reciprocity
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi * (1.0 + 0.001 * (wo[2] - wi[2]))


def sample(wo, u, p):
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
