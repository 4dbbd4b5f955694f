"""Phong's lobe is drawn within 45 degrees of the mirror direction, which costs sharp lobes nothing;
wide ones reach further.

suite: slow
caught by: cover
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 120.0


domain = {"ks": (0.0, 1.0), "n": (2.0, 1000.0)}


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


CUT = math.sqrt(0.5)


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    rest = CUT ** (p.n + 1.0)
    c = (1.0 - u[0] * (1.0 - rest)) ** (1.0 / (p.n + 1.0))
    s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * u[1]
    return around(mirror(wo), s * math.cos(phi), s * math.sin(phi), c)


def pdf(wo, wi, p):
    c = dot(mirror(wo), wi)
    if c < CUT:
        return 0.0
    return (p.n + 1.0) / (2.0 * math.pi) * c**p.n / (1.0 - CUT ** (p.n + 1.0))
