"""Phong with a weight alone, whose lobe is drawn about (-x, y, z) of the viewer: right for viewers
in the plane y = 0, and with the right albedo for all.

suite: slow
caught by: radiance
cause: mirror direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 25.0


domain = {"ks": (0.0, 1.0), "n": (1.0, 200.0)}


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
    c = max(0.0, wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1])
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    w = lobe((-wo[0], wo[1], wo[2]), u[0], u[1], p.n)
    return w[0], w[1], w[2], p.ks * (p.n + 2.0) / (p.n + 1.0) * w[2]
