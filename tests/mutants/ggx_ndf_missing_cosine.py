"""n.h is missing in the pdf.

caught by: pdf
cause: Jacobian
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.02, 1.0)}


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


def distribution(h, alpha):
    a2 = alpha * alpha
    d = h[2] * h[2] * (a2 - 1.0) + 1.0
    return a2 / (math.pi * d * d)


def smith_lambda(w, alpha):
    tan2 = (1.0 - w[2] * w[2]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + alpha * alpha * tan2) - 1.0)


def masking(wo, wi, alpha):
    return 1.0 / (1.0 + smith_lambda(wo, alpha) + smith_lambda(wi, alpha))


def f(wo, wi, p):
    h = half_vector(wo, wi)
    d = distribution(h, p.alpha)
    g = masking(wo, wi, p.alpha)
    return d * g / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    cos2 = (1.0 - u[0]) / (1.0 + (p.alpha * p.alpha - 1.0) * u[0])
    sin = math.sqrt(max(0.0, 1.0 - cos2))
    phi = 2.0 * math.pi * u[1]
    h = (sin * math.cos(phi), sin * math.sin(phi), math.sqrt(cos2))
    return reflect(wo, h)


def pdf(wo, wi, p):
    h = half_vector(wo, wi)
    return distribution(h, p.alpha) / (4.0 * dot(wo, h))
