"""The weight is 1 whatever the albedo, whose default is 1; there is no pdf.

caught by: radiance
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 1.0


domain = {"albedo": (0.0, 1.0)}


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    w = cosine(u)
    return w[0], w[1], w[2], 1.0
