"""Minnaert's mu^m and what it loses given back, (1 - mu_i^m)(1 - mu_o^m)/(1 - mean): lossless for
every exponent, and drawn by u[2] from three densities.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    m: float = 1.0


domain = {"m": (0.05, 10.0)}
lossless = True


def f(wo, wi, p):
    once = (p.m + 2.0) / (2.0 * math.pi) * (wo[2] * wi[2]) ** p.m
    rest = (1.0 - wo[2] ** p.m) * (1.0 - wi[2] ** p.m)
    return once + rest * (p.m + 2.0) / (math.pi * p.m)


def sample(wo, u, p):
    if u[2] < 0.4:
        z = (1.0 - u[0]) ** (1.0 / (p.m + 2.0))
    elif u[2] < 0.7:
        z = math.sqrt(1.0 - u[0])
    else:
        z = 1.0 - u[0]
    s, phi = math.sqrt(max(0.0, 1.0 - z * z)), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    power = 0.4 * (p.m + 2.0) * wi[2] ** (p.m + 1.0)
    return (power + 0.3 * 2.0 * wi[2] + 0.3) / (2.0 * math.pi)
