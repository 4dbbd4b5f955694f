"""Lambert of albedo 1e-200, with its sampler."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 1e-200


domain = {"albedo": (0.0, 1e-199)}


def f(wo, wi, p):
    return p.albedo / math.pi * (0.5 + wi[2] * wo[2])


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
