"""Declares an albedo, without parameters: a fit that is 5 % off about 63 degrees.

caught by: furnace
cause: angle
"""

import math


def f(wo, wi, p):
    return 0.75 * wo[2] * wi[2] / math.pi


def albedo(mu, p):
    t = math.degrees(math.acos(min(1.0, mu)))
    return 0.5 * mu * (1.0 + 0.05 * math.exp(-0.5 * ((t - 63.0) / 3.0) ** 2))
