"""Beckmann with V-cavities as textbooks print them: wo.h has hardly a digit left at grazing."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.05, 1.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def f(wo, wi, p):
    h = normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))
    c2 = h[2] * h[2]
    t2 = (1.0 - c2) / c2
    d = math.exp(-t2 / (p.alpha * p.alpha)) / (math.pi * p.alpha * p.alpha * c2 * c2)
    g = min(1.0, 2.0 * h[2] * wo[2] / dot(wo, h), 2.0 * h[2] * wi[2] / dot(wo, h))
    return d * g / (4.0 * wo[2] * wi[2])
