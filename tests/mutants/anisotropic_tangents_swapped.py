"""Tangent and bitangent are swapped.

caught by: equality
cause: swapped directions
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha_x: float = 0.2
    alpha_y: float = 0.4


domain = {"alpha_x": (0.05, 1.0), "alpha_y": (0.05, 1.0)}
isotropic = False
same_as = "ggx_anisotropic"


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def distribution(h, p):
    k = (h[1] / p.alpha_x) ** 2 + (h[0] / p.alpha_y) ** 2 + h[2] * h[2]
    return 1.0 / (math.pi * p.alpha_x * p.alpha_y * k * k)


def smith_lambda(w, p):
    a2 = ((p.alpha_x * w[0]) ** 2 + (p.alpha_y * w[1]) ** 2) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + a2) - 1.0)


def f(wo, wi, p):
    d = distribution(half_vector(wo, wi), p)
    g = 1.0 / (1.0 + smith_lambda(wo, p) + smith_lambda(wi, p))
    return d * g / (4.0 * wo[2] * wi[2])
