"""Directions of the whole sphere are folded up with abs(), the pdf is the sphere's.

caught by: pdf
cause: horizon
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    z = 1.0 - 2.0 * u[0]
    r = math.sqrt(max(0.0, 1.0 - z * z))
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), abs(z)


def pdf(wo, wi, p):
    return 1.0 / (4.0 * math.pi)
