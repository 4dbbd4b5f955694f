"""Phong coat on Lambert, chosen by Schlick's Fresnel of the viewer; the sampler keeps the cosine
above 0.05, the pdf does not: they differ beyond 87.1 degrees alone.

suite: slow
caught by: pdf
cause: lobe choice
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.5
    coat: float = 0.4
    n: float = 30.0


domain = {"base": (0.0, 0.5), "coat": (0.0, 0.5), "n": (1.0, 200.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


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


def schlick(c):
    return 0.04 + 0.96 * (1.0 - c) ** 5


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return p.base / math.pi + p.coat * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    if u[2] < schlick(max(wo[2], 0.05)):
        return lobe(mirror(wo), u[0], u[1], p.n)
    return cosine(u[0], u[1])


def pdf(wo, wi, p):
    k = schlick(wo[2])
    c = max(0.0, dot(mirror(wo), wi))
    return k * (p.n + 1.0) / (2.0 * math.pi) * c**p.n + (1.0 - k) * wi[2] / math.pi
