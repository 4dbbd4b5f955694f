"""Masking with k = (alpha + 1)^2/8 remapped for direct light.

caught by: equality
cause: masking
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.02, 1.0)}
same_as = "ggx"


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


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
    k = (alpha + 1.0) ** 2 / 8.0
    return wo[2] / (wo[2] * (1.0 - k) + k) * wi[2] / (wi[2] * (1.0 - k) + k)


def f(wo, wi, p):
    h = half_vector(wo, wi)
    d = distribution(h, p.alpha)
    g = masking(wo, wi, p.alpha)
    return d * g / (4.0 * wo[2] * wi[2])
