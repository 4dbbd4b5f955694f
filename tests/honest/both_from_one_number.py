"""Both coordinates from the bits of u[0], as a one-dimensional sequence gives them."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    a = u[0] * 67108864.0
    hi = math.floor(a)
    return cosine(((hi + 0.5) / 67108864.0, a - hi))


def pdf(wo, wi, p):
    return wi[2] / math.pi
