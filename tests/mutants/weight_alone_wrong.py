"""A weight without a pdf, with the pi of cosine sampling forgotten.

caught by: furnace
cause: factor 1/pi missing
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
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0]), p.albedo / math.pi
