"""Blinn-Phong with the normalisation copied from Phong: about four times too much.

caught by: energy
cause: factor 4
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 32.0


domain = {"ks": (0.0, 1.0), "n": (0.0, 1000.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def f(wo, wi, p):
    c = max(0.0, half_vector(wo, wi)[2])
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n
