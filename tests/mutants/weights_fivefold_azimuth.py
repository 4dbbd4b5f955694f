"""Lambert with a weight alone; azimuths bunch towards five spokes, which the constant weight does
not know: the albedo is right, no direction is.

suite: slow
caught by: cover
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    turn = u[1] + 0.3 * math.sin(10.0 * math.pi * u[1]) / (10.0 * math.pi)
    phi = 2.0 * math.pi * turn
    r = math.sqrt(u[0])
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0]), p.albedo
