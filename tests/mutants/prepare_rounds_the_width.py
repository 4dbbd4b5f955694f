"""GGX by its normals; prepare() keys its cache with the width in two decimals and the pdf takes
the rounded one.

suite: slow
caught by: pdf
cause: width
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


class Widths(NamedTuple):
    alpha: float
    key: float


domain = {"alpha": (0.02, 0.9)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half(wo, wi):
    return norm((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def reflect(wo, h):
    k = 2.0 * dot(wo, h)
    return k * h[0] - wo[0], k * h[1] - wo[1], k * h[2] - wo[2]


def density(h, a):
    k = h[2] * h[2] + (h[0] * h[0] + h[1] * h[1]) / (a * a)
    return 1.0 / (math.pi * a * a * k * k)


def lam(w, a):
    t2 = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + a * a * t2) - 1.0)


def facets(wo, wi, a):
    g = 1.0 / (1.0 + lam(wo, a) + lam(wi, a))
    return density(half(wo, wi), a) * g / (4.0 * wo[2] * wi[2])


def prepare(p):
    return Widths(p.alpha, round(p.alpha, 2))


def f(wo, wi, p):
    return facets(wo, wi, p.alpha)


def sample(wo, u, p):
    tan = p.alpha * math.sqrt(u[1] / (1.0 - u[1]))
    phi = 2.0 * math.pi * u[0]
    return reflect(wo, norm((tan * math.cos(phi), tan * math.sin(phi), 1.0)))


def pdf(wo, wi, p):
    h = half(wo, wi)
    return density(h, p.key) * h[2] / (4.0 * dot(wo, h))
