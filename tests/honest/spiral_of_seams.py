"""Azimuth from the fraction of u[1] + 5 u[0]: seams run through the square where nothing jumps.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    c = wo[0] * wi[0] + wo[1] * wi[1]
    return p.albedo / math.pi * (1.0 + 0.5 * c * wo[2] * wi[2])


def sample(wo, u, p):
    turn = u[1] + 5.0 * u[0]
    phi = 2.0 * math.pi * (turn - math.floor(turn))
    r = math.sqrt(u[0])
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
