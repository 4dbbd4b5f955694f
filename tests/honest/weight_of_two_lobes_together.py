"""Phong on Lambert with a weight alone: whichever lobe was drawn, the weight is f cos over the
density of both.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.4
    ks: float = 0.5
    n: float = 80.0


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5), "n": (1.0, 1000.0)}


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
    return p.kd / math.pi + p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    w = cosine(u[0], u[1])
    if u[2] < 0.6:
        w = lobe(mirror(wo), u[0], u[1], p.n)
    if w[2] <= 0.0:
        return 0.0, 0.0, -1.0, 0.0
    c = max(0.0, dot(mirror(wo), w))
    density = 0.6 * (p.n + 1.0) / (2.0 * math.pi) * c**p.n + 0.4 * w[2] / math.pi
    return w[0], w[1], w[2], f(wo, w, p) * w[2] / density
