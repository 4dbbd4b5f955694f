"""Roughness is clamped in the sampler only, which shows at high exponents.

caught by: pdf
cause: width
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.5
    ks: float = 0.4
    n: float = 40.0


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5), "n": (1.0, 1000.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
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


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return p.kd / math.pi + p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    phi = 2.0 * math.pi * u[1]
    if u[2] < 0.5:
        r = math.sqrt(u[0])
        return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])
    cos = (1.0 - u[0]) ** (1.0 / (min(p.n, 100.0) + 1.0))
    sin = math.sqrt(max(0.0, 1.0 - cos * cos))
    return around(mirror(wo), sin * math.cos(phi), sin * math.sin(phi), cos)


def pdf(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    specular = (p.n + 1.0) / (2.0 * math.pi) * c**p.n
    return 0.5 * wi[2] / math.pi + 0.5 * specular
