"""Beckmann's distribution without 1/pi.

caught by: energy
cause: factor 1/pi missing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.05, 0.6)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def distribution(h, alpha):
    cos2 = h[2] * h[2]
    tan2 = max(0.0, 1.0 - cos2) / cos2
    return math.exp(-tan2 / (alpha * alpha)) / (alpha * alpha * cos2 * cos2)


def smith_lambda(w, alpha):
    tan = math.sqrt(max(0.0, 1.0 - w[2] * w[2])) / w[2]
    if tan <= 0.0:
        return 0.0
    a = 1.0 / (alpha * tan)
    return 0.5 * (math.exp(-a * a) / (a * math.sqrt(math.pi)) - math.erfc(a))


def f(wo, wi, p):
    h = half_vector(wo, wi)
    g = 1.0 / (1.0 + smith_lambda(wo, p.alpha) + smith_lambda(wi, p.alpha))
    return distribution(h, p.alpha) * g / (4.0 * wo[2] * wi[2])
