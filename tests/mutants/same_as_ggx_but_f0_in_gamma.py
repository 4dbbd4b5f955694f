"""GGX, declared to be ggx; f0 is decoded as if it were a colour of an image, which leaves the
default of 1 as it is.

suite: slow
caught by: equality
cause: parameter convention
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3
    f0: float = 1.0


domain = {"alpha": (0.01, 1.0), "f0": (0.0, 1.0)}
same_as = "ggx"


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half(wo, wi):
    return norm((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def density(h, a):
    k = h[2] * h[2] + (h[0] * h[0] + h[1] * h[1]) / (a * a)
    return 1.0 / (math.pi * a * a * k * k)


def lam(w, a):
    t2 = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + a * a * t2) - 1.0)


def facets(wo, wi, a):
    g = 1.0 / (1.0 + lam(wo, a) + lam(wi, a))
    return density(half(wo, wi), a) * g / (4.0 * wo[2] * wi[2])


def f(wo, wi, p):
    f0 = p.f0**2.2
    c = dot(wo, half(wo, wi))
    return (f0 + (1.0 - f0) * (1.0 - c) ** 5) * facets(wo, wi, p.alpha)
