"""A lobe chosen by u[0], which is then rescaled: a direction belongs to two pairs of numbers."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.5
    ks: float = 0.4


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5)}
N = 20.0


def f(wo, wi, p):
    return p.kd / math.pi + p.ks * (N + 2.0) / (2.0 * math.pi) * (wi[2] * wo[2]) ** N


def sample(wo, u, p):
    if u[0] < 0.4:
        a = u[0] / 0.4
        c = (1.0 - a) ** (1.0 / (N + 2.0))
    else:
        a = (u[0] - 0.4) / 0.6
        c = math.sqrt(1.0 - a)
    s = math.sqrt(max(0.0, 1.0 - c * c))
    phi = 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), c


def pdf(wo, wi, p):
    return 0.4 * (N + 2.0) / (2.0 * math.pi) * wi[2] ** (N + 1.0) + 0.6 * wi[2] / math.pi
