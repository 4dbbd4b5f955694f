"""A lobe of both directions about a normal bent by 30 degrees, which no mirror and no viewer points
at; u[0] chooses it in three of ten draws and is used again.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.5
    shine: float = 0.4
    n: float = 800.0


domain = {"base": (0.0, 0.5), "shine": (0.0, 0.5), "n": (50.0, 5000.0)}
isotropic = False


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


BENT = (0.5, 0.0, math.sqrt(0.75))


def f(wo, wi, p):
    both = max(0.0, dot(BENT, wo)) * max(0.0, dot(BENT, wi))
    return p.base / math.pi + p.shine * (p.n + 1.0) / (2.0 * math.pi) * both**p.n


def sample(wo, u, p):
    if u[0] < 0.3:
        return lobe(BENT, u[0] / 0.3, u[1], p.n)
    return cosine((u[0] - 0.3) / 0.7, u[1])


def pdf(wo, wi, p):
    c = max(0.0, dot(BENT, wi))
    return 0.3 * (p.n + 1.0) / (2.0 * math.pi) * c**p.n + 0.7 * wi[2] / math.pi
