"""GGX whose denominator keeps both cosines above 0.05: a kink in either, the same for both, and
less light than without it.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.2


domain = {"alpha": (0.05, 1.0)}


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


def visible(wo, u, a):
    v = norm((a * wo[0], a * wo[1], wo[2]))
    phi = 2.0 * math.pi * u[0]
    z = (1.0 - u[1]) * (1.0 + v[2]) - v[2]
    s = math.sqrt(max(0.0, 1.0 - z * z))
    h = (s * math.cos(phi) + v[0], s * math.sin(phi) + v[1], z + v[2])
    return reflect(wo, norm((a * h[0], a * h[1], max(h[2], 1e-12))))


def visible_pdf(wo, wi, a):
    return density(half(wo, wi), a) / (4.0 * wo[2] * (1.0 + lam(wo, a)))


def f(wo, wi, p):
    kept = wo[2] * wi[2] / (max(0.05, wo[2]) * max(0.05, wi[2]))
    return facets(wo, wi, p.alpha) * kept


def sample(wo, u, p):
    return visible(wo, u, p.alpha)


def pdf(wo, wi, p):
    return visible_pdf(wo, wi, p.alpha)
