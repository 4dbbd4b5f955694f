"""f and the returned weight are exactly 0 beyond 60 degrees, where the pdf is not."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def f(wo, wi, p):
    return p.albedo / math.pi if wo[2] > 0.5 and wi[2] > 0.5 else 0.0


def sample(wo, u, p):
    w = cosine(u)
    k = p.albedo if wo[2] > 0.5 and w[2] > 0.5 else 0.0
    return w[0], w[1], w[2], k


def pdf(wo, wi, p):
    return wi[2] / math.pi
