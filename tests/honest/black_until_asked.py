"""A lobe that is switched off at the default of 0, and black with it; its sampler works on.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    strength: float = 0.0
    n: float = 30.0


domain = {"strength": (0.0, 1.0), "n": (1.0, 300.0)}


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


def lobe(axis, a, b, n):
    """A direction about `axis`, by a power of the cosine."""
    c = (1.0 - a) ** (1.0 / (n + 1.0))
    s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * b
    return around(axis, s * math.cos(phi), s * math.sin(phi), c)


def f(wo, wi, p):
    return p.strength * (p.n + 1.0) / (2.0 * math.pi) * max(0.0, dot(wo, wi)) ** p.n


def sample(wo, u, p):
    return lobe(wo, u[0], u[1], p.n)


def pdf(wo, wi, p):
    return (p.n + 1.0) / (2.0 * math.pi) * max(0.0, dot(wo, wi)) ** p.n
