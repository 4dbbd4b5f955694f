"""Anisotropic GGX by its normals; the sampler puts the larger width along x, as exporters do that
sort them, so that it is wrong where ay is the larger one.

suite: slow
caught by: pdf
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ax: float = 0.4
    ay: float = 0.2


domain = {"ax": (0.05, 0.8), "ay": (0.05, 0.8)}
isotropic = False


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


def density(h, p):
    k = (h[0] / p.ax) ** 2 + (h[1] / p.ay) ** 2 + h[2] * h[2]
    return 1.0 / (math.pi * p.ax * p.ay * k * k)


def lam(w, p):
    t2 = ((p.ax * w[0]) ** 2 + (p.ay * w[1]) ** 2) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + t2) - 1.0)


def f(wo, wi, p):
    g = 1.0 / (1.0 + lam(wo, p) + lam(wi, p))
    return density(half(wo, wi), p) * g / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    a, b = max(p.ax, p.ay), min(p.ax, p.ay)
    r = math.sqrt(u[0] / (1.0 - u[0]))
    phi = 2.0 * math.pi * u[1]
    return reflect(wo, norm((a * r * math.cos(phi), b * r * math.sin(phi), 1.0)))


def pdf(wo, wi, p):
    h = half(wo, wi)
    return density(h, p) * h[2] / (4.0 * dot(wo, h))
