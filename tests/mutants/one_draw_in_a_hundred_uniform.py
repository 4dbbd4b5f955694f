"""Lambert; one draw in a hundred is uniform, so that grazing lights are met, and the pdf does not
know it.

suite: slow
caught by: radiance
cause: lobe choice
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def cosine(a, b):
    r, phi = math.sqrt(a), 2.0 * math.pi * b
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - a)


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    if u[2] > 0.99:
        s, phi = math.sqrt(1.0 - u[0] * u[0]), 2.0 * math.pi * u[1]
        return s * math.cos(phi), s * math.sin(phi), u[0]
    return cosine(u[0], u[1])


def pdf(wo, wi, p):
    return wi[2] / math.pi
