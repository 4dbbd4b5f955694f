"""Exactly 0 unless both directions lie within a cone, as louvres are."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    inside = 1.0 if wi[2] > 0.7 and wo[2] > 0.4 or wi[2] > 0.4 and wo[2] > 0.7 else 0.0
    return inside * p.albedo / math.pi


def sample(wo, u, p):
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
