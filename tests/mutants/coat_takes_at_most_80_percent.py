"""A coat over a diffuse base; what it takes from the base is clamped at 0.8, what it reflects is
not.

suite: slow
caught by: energy
cause: inside the ranges
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.6
    coat: float = 0.3
    n: float = 50.0


domain = {"base": (0.0, 1.0), "coat": (0.0, 1.0), "n": (5.0, 500.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def around(axis, x, y, z):
    """(x, y, z) of a frame whose third axis is `axis` (Frisvad 2012)."""
    a = 1.0 / (1.0 + axis[2])
    b = -axis[0] * axis[1] * a
    t = (1.0 - axis[0] * axis[0] * a, b, -axis[0])
    s = (b, 1.0 - axis[1] * axis[1] * a, -axis[1])
    return (
        x * t[0] + y * s[0] + z * axis[0],
        x * t[1] + y * s[1] + z * axis[1],
        x * t[2] + y * s[2] + z * axis[2],
    )


def mirror(wo):
    return -wo[0], -wo[1], wo[2]


def cosine(a, b):
    r, phi = math.sqrt(a), 2.0 * math.pi * b
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - a)


def lobe(axis, a, b, n):
    """A direction about `axis`, by a power of the cosine."""
    c = (1.0 - a) ** (1.0 / (n + 1.0))
    s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * b
    return around(axis, s * math.cos(phi), s * math.sin(phi), c)


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    diffuse = p.base * (1.0 - min(p.coat, 0.8)) / math.pi
    return diffuse + p.coat * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    if u[2] < 0.5:
        return lobe(mirror(wo), u[0], u[1], p.n)
    return cosine(u[0], u[1])


def pdf(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return 0.5 * (p.n + 1.0) / (2.0 * math.pi) * c**p.n + 0.5 * wi[2] / math.pi
