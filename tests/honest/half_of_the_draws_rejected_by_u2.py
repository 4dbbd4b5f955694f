"""Uniform directions, kept with the probability of their cosine: half of the draws are rejected and
the pdf says so.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi * math.sqrt(wo[2] * wi[2])


def sample(wo, u, p):
    s, phi = math.sqrt(max(0.0, 1.0 - u[0] * u[0])), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), u[0] if u[2] < u[0] else -1.0


def pdf(wo, wi, p):
    return wi[2] / (2.0 * math.pi)
