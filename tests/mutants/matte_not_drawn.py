"""Phong lobe and a matte part, of which the lobe alone is drawn. There is none at the defaults.

suite: slow
caught by: cover
cause: not drawn
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.0
    ks: float = 0.5
    n: float = 20.0


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5), "n": (1.0, 1000.0)}


def mirror_cosine(wo, wi):
    return wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1]


def f(wo, wi, p):
    c = max(0.0, mirror_cosine(wo, wi))
    return p.kd / math.pi + p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    phi = 2.0 * math.pi * u[1]
    c = (1.0 - u[0]) ** (1.0 / (p.n + 1.0))
    s = math.sqrt(max(0.0, 1.0 - c * c))
    x, y, z = s * math.cos(phi), s * math.sin(phi), c
    mx, my, mz = -wo[0], -wo[1], wo[2]
    k = 1.0 / (1.0 + mz)
    wx = (1.0 - k * mx * mx) * x - k * mx * my * y + mx * z
    wy = -k * mx * my * x + (1.0 - k * my * my) * y + my * z
    return wx, wy, -mx * x - my * y + mz * z


def pdf(wo, wi, p):
    c = max(0.0, mirror_cosine(wo, wi))
    return (p.n + 1.0) / (2.0 * math.pi) * c**p.n
