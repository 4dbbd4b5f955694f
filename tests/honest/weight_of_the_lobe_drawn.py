"""Two Lambert lobes, one drawn by cosine and one evenly, each weighted by itself alone: right on
average, though not f cos/pdf for the direction at hand.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    a: float = 0.5
    b: float = 0.3


domain = {"a": (0.0, 0.5), "b": (0.0, 0.5)}


def f(wo, wi, p):
    return (p.a + p.b) / math.pi


def sample(wo, u, p):
    phi = 2.0 * math.pi * u[1]
    if u[2] < 0.5:
        r = math.sqrt(u[0])
        return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0]), 2.0 * p.a
    r = math.sqrt(u[0] * (2.0 - u[0]))
    z = 1.0 - u[0]
    return r * math.cos(phi), r * math.sin(phi), z, 4.0 * p.b * z


def pdf(wo, wi, p):
    return 0.5 * wi[2] / math.pi + 0.25 / math.pi
