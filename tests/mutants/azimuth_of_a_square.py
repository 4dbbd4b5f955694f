"""Lambert by weights: azimuths are those of a square, 57 % too dense on its diagonals.

suite: slow
caught by: cover
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.7


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    phi = math.atan2(2.0 * u[1] - 1.0, 2.0 * u[0] - 1.0)
    r = math.sqrt(u[2])
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[2]), p.albedo
