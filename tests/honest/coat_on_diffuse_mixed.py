"""Clear coat over Lambert, attenuated both ways; one of the two is drawn.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.8
    alpha: float = 0.1
    coat: float = 1.0


domain = {"base": (0.0, 1.0), "alpha": (0.02, 1.0), "coat": (0.0, 1.0)}


def schlick(c):
    return 0.04 + 0.96 * (1.0 - c) ** 5


def distribution(c, a):
    t = c * c * (a * a - 1.0) + 1.0
    return a * a / (math.pi * t * t)


def lam(c, a):
    return 0.5 * (math.sqrt(1.0 + a * a * (1.0 - c * c) / (c * c)) - 1.0)


def half(wo, wi):
    hx, hy, hz = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    n = 1.0 / math.sqrt(hx * hx + hy * hy + hz * hz)
    return hx * n, hy * n, hz * n


def coat_prob(wo, p):
    return 0.25 + 0.5 * p.coat * schlick(wo[2])


def f(wo, wi, p):
    hx, hy, hz = half(wo, wi)
    voh = wo[0] * hx + wo[1] * hy + wo[2] * hz
    spec = (
        distribution(hz, p.alpha)
        * schlick(voh)
        / (4.0 * wo[2] * wi[2])
        / (1.0 + lam(wo[2], p.alpha) + lam(wi[2], p.alpha))
    )
    through = (1.0 - p.coat * schlick(wo[2])) * (1.0 - p.coat * schlick(wi[2]))
    return p.coat * spec + through * p.base / math.pi


def sample(wo, u, p):
    if u[2] < coat_prob(wo, p):
        t = u[0] * p.alpha * p.alpha / (1.0 - u[0])
        c = 1.0 / math.sqrt(1.0 + t)
        s = math.sqrt(max(0.0, 1.0 - c * c))
        phi = 2.0 * math.pi * u[1]
        hx, hy, hz = s * math.cos(phi), s * math.sin(phi), c
        d = 2.0 * (wo[0] * hx + wo[1] * hy + wo[2] * hz)
        return d * hx - wo[0], d * hy - wo[1], d * hz - wo[2]
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    hx, hy, hz = half(wo, wi)
    voh = wo[0] * hx + wo[1] * hy + wo[2] * hz
    q = coat_prob(wo, p)
    return q * distribution(hz, p.alpha) * hz / (4.0 * voh) + (1.0 - q) * wi[2] / math.pi
