"""(mu_i + mu_o)^-m up to m = 1.8: without bound where both directions graze, and integrable. The
draws crowd at the horizon, where the pdf has no bound either.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9
    m: float = 1.5


domain = {"albedo": (0.0, 1.0), "m": (0.0, 1.8)}


def f(wo, wi, p):
    return p.albedo * (2.0 - p.m) / (2.0 * math.pi) * (wo[2] + wi[2]) ** -p.m


def sample(wo, u, p):
    z = u[0] ** (1.0 / (2.0 - p.m))
    s, phi = math.sqrt(max(0.0, 1.0 - z * z)), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    return (2.0 - p.m) / (2.0 * math.pi) * wi[2] ** (1.0 - p.m)
