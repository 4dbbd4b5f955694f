"""Half of the draws in a cone around the normal, half outside: a density with a step."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    z = 0.8 + 0.4 * u[0] if u[0] < 0.5 else 1.6 * (u[0] - 0.5)
    r = math.sqrt(max(0.0, 1.0 - z * z))
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), z


def pdf(wo, wi, p):
    return (2.5 if wi[2] > 0.8 else 0.625) / (2.0 * math.pi)
