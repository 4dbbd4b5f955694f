"""A lobe chosen by u[0] in 0.6 % of the draws, rescaled; f Lambert plus a weak lobe."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.5


domain = {"kd": (0.0, 0.9)}
N, Q = 20.0, 0.006


def f(wo, wi, p):
    return p.kd / math.pi + 0.002 * (N + 2.0) / (2.0 * math.pi) * (wi[2] * wo[2]) ** N


def sample(wo, u, p):
    if u[0] < Q:
        c = (1.0 - u[0] / Q) ** (1.0 / (N + 2.0))
    else:
        c = math.sqrt(1.0 - (u[0] - Q) / (1.0 - Q))
    s = math.sqrt(max(0.0, 1.0 - c * c))
    phi = 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), c


def pdf(wo, wi, p):
    return Q * (N + 2.0) / (2.0 * math.pi) * wi[2] ** (N + 1.0) + (1.0 - Q) * wi[2] / math.pi
