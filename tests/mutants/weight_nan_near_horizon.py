"""The weight of a drawn direction near the horizon is NaN.

caught by: pdf
cause: not finite
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    z = math.sqrt(1.0 - u[0])
    weight = p.albedo if z > 0.05 else math.nan
    return r * math.cos(phi), r * math.sin(phi), z, weight


def pdf(wo, wi, p):
    return wi[2] / math.pi
