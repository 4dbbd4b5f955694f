"""u is mirrored and its numbers are swapped."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    a = 1.0 - u[1]
    r = math.sqrt(1.0 - a)
    phi = 2.0 * math.pi * (1.0 - u[0])
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(a)


def pdf(wo, wi, p):
    return wi[2] / math.pi
