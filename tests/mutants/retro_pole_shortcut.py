"""Retro-reflector; a frame about the viewer is not built within 1.8 degrees of the normal, the
lobe is drawn about the normal there. Sharp lobes miss their place.

suite: slow
caught by: cover
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    k: float = 0.5
    n: float = 400.0


domain = {"k": (0.0, 1.0), "n": (10.0, 20000.0)}


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


def cosine(a, b):
    r, phi = math.sqrt(a), 2.0 * math.pi * b
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - a)


def lobe(axis, a, b, n):
    """A direction about `axis`, by a power of the cosine."""
    c = (1.0 - a) ** (1.0 / (n + 1.0))
    s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * b
    return around(axis, s * math.cos(phi), s * math.sin(phi), c)


def f(wo, wi, p):
    c = max(0.0, dot(wo, wi))
    return (1.0 - p.k) / math.pi + p.k * (p.n + 1.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    if u[2] < 0.5:
        return cosine(u[0], u[1])
    if wo[2] > 0.9995:
        return lobe((0.0, 0.0, 1.0), u[0], u[1], p.n)
    return lobe(wo, u[0], u[1], p.n)


def pdf(wo, wi, p):
    c = max(0.0, dot(wo, wi))
    return 0.5 * wi[2] / math.pi + 0.5 * (p.n + 1.0) / (2.0 * math.pi) * c**p.n
