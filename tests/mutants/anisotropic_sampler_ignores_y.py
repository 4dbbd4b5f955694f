"""The sampler is isotropic; at the defaults both widths are equal and nothing shows.

caught by: pdf
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha_x: float = 0.4
    alpha_y: float = 0.4


domain = {"alpha_x": (0.05, 1.0), "alpha_y": (0.05, 1.0)}
isotropic = False


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def reflect(v, n):
    k = 2.0 * dot(v, n)
    return k * n[0] - v[0], k * n[1] - v[1], k * n[2] - v[2]


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def distribution(h, p):
    k = (h[0] / p.alpha_x) ** 2 + (h[1] / p.alpha_y) ** 2 + h[2] * h[2]
    return 1.0 / (math.pi * p.alpha_x * p.alpha_y * k * k)


def smith_lambda(w, p):
    a2 = ((p.alpha_x * w[0]) ** 2 + (p.alpha_y * w[1]) ** 2) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + a2) - 1.0)


def f(wo, wi, p):
    d = distribution(half_vector(wo, wi), p)
    g = 1.0 / (1.0 + smith_lambda(wo, p) + smith_lambda(wi, p))
    return d * g / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    r = math.sqrt(u[0] / (1.0 - u[0]))
    phi = 2.0 * math.pi * u[1]
    h = normalize((p.alpha_x * r * math.cos(phi), p.alpha_x * r * math.sin(phi), 1.0))
    return reflect(wo, h)


def pdf(wo, wi, p):
    h = half_vector(wo, wi)
    return distribution(h, p) * h[2] / (4.0 * dot(wo, h))
