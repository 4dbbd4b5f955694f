"""1 + k g(mu_i) g(mu_o) with a g that integrates to 0: nothing is lost or won at any angle, though
f is half as large here and twice as large there. At k = 0 it is lambert.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 1.0
    k: float = 0.8


domain = {"albedo": (0.0, 1.0), "k": (0.0, 1.0)}
lossless = [Params(), Params(k=0.0), Params(k=1.0)]
limits = [({"k": 0.0}, "lambert")]


def f(wo, wi, p):
    return p.albedo / math.pi * (1.0 + p.k * (1.0 - 1.5 * wo[2]) * (1.0 - 1.5 * wi[2]))


def albedo(mu, p):
    return p.albedo
