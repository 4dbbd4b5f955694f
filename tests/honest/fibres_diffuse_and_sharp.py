"""Fibres along y: a diffuse part by the sines to the fibre and a cone of reflection, chosen by
u[0] with a chance that depends on the viewer.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    diffuse: float = 0.4
    cone: float = 0.5
    width: float = 0.03


domain = {"diffuse": (0.0, 0.5), "cone": (0.0, 0.5), "width": (0.005, 0.3)}
isotropic = False


def chance(wo):
    return 0.2 + 0.6 * wo[2]


def bell(x, w):
    return math.exp(-0.5 * (x / w) ** 2) / (w * math.sqrt(2.0 * math.pi))


def f(wo, wi, p):
    a = wo[0] * wo[0] + wo[2] * wo[2]
    b = wi[0] * wi[0] + wi[2] * wi[2]
    sharp = 0.5 * bell(wo[1] + wi[1], p.width)
    return p.diffuse * math.sqrt(a * b) / math.pi + p.cone * sharp


def sample(wo, u, p):
    k = chance(wo)
    if u[0] >= k:
        v = (u[0] - k) / (1.0 - k)
        r, phi = math.sqrt(v), 2.0 * math.pi * u[1]
        return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - v)
    bend = math.sqrt(-2.0 * math.log(1.0 - u[0] / k)) * math.cos(2.0 * math.pi * u[1])
    y = p.width * bend - wo[1]
    if abs(y) >= 1.0:
        return 0.0, 0.0, -1.0
    x = (2.0 * u[2] - 1.0) * math.sqrt(1.0 - y * y)
    return x, y, math.sqrt(max(0.0, 1.0 - x * x - y * y))


def pdf(wo, wi, p):
    b = wi[0] * wi[0] + wi[2] * wi[2]
    cone = 0.5 * bell(wo[1] + wi[1], p.width) * wi[2] / math.sqrt(b)
    k = chance(wo)
    return k * cone + (1.0 - k) * wi[2] / math.pi
