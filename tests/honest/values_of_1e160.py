"""f of 1e160, energy disclaimed."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    c: float = 1e160


domain = {"c": (1e159, 1e160)}
disclaims = {"energy": "in arbitrary units"}


def f(wo, wi, p):
    return p.c * (0.5 + wi[2] * wo[2])


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
