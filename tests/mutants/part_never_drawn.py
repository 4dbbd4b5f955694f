"""Directions near the horizon are never drawn; the pdf knows it, f does not.

caught by: furnace
cause: not drawn
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    v = 0.95 * u[0]
    r = math.sqrt(v)
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - v)


def pdf(wo, wi, p):
    return wi[2] / math.pi / 0.95 if wi[2] * wi[2] > 0.05 else 0.0
