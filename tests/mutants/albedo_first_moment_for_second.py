"""rho/pi times (1 - k + k mu) of either direction, with its albedo in closed form: the mean of mu
is taken for 1/2 where it is 2/3. Nothing shows at the default k = 0.

suite: slow
caught by: furnace
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    rho: float = 0.8
    k: float = 0.0


domain = {"rho": (0.0, 1.0), "k": (0.0, 1.0)}


def f(wo, wi, p):
    return p.rho / math.pi * (1.0 - p.k + p.k * wo[2]) * (1.0 - p.k + p.k * wi[2])


def albedo(mu, p):
    return p.rho * (1.0 - p.k + p.k * mu) * (1.0 - 0.5 * p.k)
