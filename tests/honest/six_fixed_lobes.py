"""Six lobes about six fixed directions of an etched plate, one of them chosen by u[2]: the pdf is
the sum of six.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.3
    n: float = 60.0


domain = {"base": (0.0, 0.4), "n": (10.0, 1000.0)}
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


def axis(k):
    t, phi = 0.35 + 0.05 * k, 2.4 * k
    return math.sin(t) * math.cos(phi), math.sin(t) * math.sin(phi), math.cos(t)


def f(wo, wi, p):
    total = p.base / math.pi
    for k in range(6):
        a = axis(k)
        both = max(0.0, dot(a, wo)) * max(0.0, dot(a, wi))
        total += 0.1 * (p.n + 1.0) / (2.0 * math.pi) * both**p.n
    return total


def sample(wo, u, p):
    if u[2] < 0.4:
        return cosine(u[0], u[1])
    k = min(5, int((u[2] - 0.4) * 10.0))
    return lobe(axis(k), u[0], u[1], p.n)


def pdf(wo, wi, p):
    total = 0.4 * wi[2] / math.pi
    for k in range(6):
        c = max(0.0, dot(axis(k), wi))
        total += 0.1 * (p.n + 1.0) / (2.0 * math.pi) * c**p.n
    return total
