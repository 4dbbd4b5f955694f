"""n + a direction on the sphere, not normalised.

caught by: pdf
cause: not of unit length
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    z = 1.0 - 2.0 * u[0]
    r = math.sqrt(max(0.0, 1.0 - z * z))
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), 1.0 + z


def pdf(wo, wi, p):
    return wi[2] / math.pi
