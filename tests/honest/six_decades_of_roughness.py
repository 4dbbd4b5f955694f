"""A darkening towards grazing angles by r/(1 + r), r from 0.001 to 1,000, with its albedo in closed
form.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    rho: float = 0.9
    r: float = 1.0


domain = {"rho": (0.0, 1.0), "r": (1e-3, 1e3)}


def f(wo, wi, p):
    k = p.r / (1.0 + p.r)
    return p.rho / math.pi * (1.0 - k * (1.0 - wo[2]) * (1.0 - wi[2]))


def albedo(mu, p):
    return p.rho * (1.0 - p.r / (1.0 + p.r) * (1.0 - mu) / 3.0)
