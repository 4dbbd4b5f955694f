"""Metal and dielectric blended; the sampler keeps the chance of either lobe above a tenth, the pdf
takes the blend as it is: nothing shows between 0.1 and 0.9.

suite: slow
caught by: pdf
cause: lobe choice
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.8
    metal: float = 0.5
    alpha: float = 0.3


domain = {"base": (0.0, 1.0), "metal": (0.0, 1.0), "alpha": (0.05, 0.8)}


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


def cosine(a, b):
    r, phi = math.sqrt(a), 2.0 * math.pi * b
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - a)


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
    diffuse = (1.0 - p.metal) * p.base / math.pi
    return diffuse + p.metal * p.base * facets(wo, wi, p.alpha)


def sample(wo, u, p):
    if u[2] < min(0.9, max(0.1, p.metal)):
        return visible(wo, u, p.alpha)
    return cosine(u[0], u[1])


def pdf(wo, wi, p):
    k = p.metal
    return k * visible_pdf(wo, wi, p.alpha) + (1.0 - k) * wi[2] / math.pi
