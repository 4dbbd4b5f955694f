"""A special case for viewers near the normal, forgotten for the light.

caught by: reciprocity
cause: one direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    edge = 0.9 if wo[2] > 0.995 else 1.0
    return edge * p.albedo / math.pi


def sample(wo, u, p):
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
