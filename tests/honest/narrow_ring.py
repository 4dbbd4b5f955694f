"""A ring of 0.1 degrees at 33.3 degrees, as diffraction makes it, that no quadrature expects."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albedo": (0.0, 0.6)}


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def g(c):
    t = math.degrees(math.acos(min(1.0, c))) - 33.3
    return 1.0 + 0.5 * math.exp(-0.5 * (t / 0.1) ** 2)


def f(wo, wi, p):
    return p.albedo / math.pi * g(wo[2]) * g(wi[2])


def sample(wo, u, p):
    return cosine(u)


def pdf(wo, wi, p):
    return wi[2] / math.pi
