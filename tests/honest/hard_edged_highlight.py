"""A disk of one brightness about the mirror direction, hard at its edge, on a diffuse base; it is
drawn by u[2] and cut by the horizon.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.3
    ks: float = 0.6
    radius: float = 0.15


domain = {"kd": (0.0, 0.4), "ks": (0.0, 0.6), "radius": (0.01, 0.7)}


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


def inside(wo, wi, radius):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] - wi[2]
    reach = 2.0 * math.sin(0.5 * radius)
    return x * x + y * y + z * z <= reach * reach


def f(wo, wi, p):
    disk = 1.0 / (math.pi * math.sin(p.radius) ** 2) if inside(wo, wi, p.radius) else 0.0
    return p.kd / math.pi + p.ks * disk


def sample(wo, u, p):
    if u[2] < 0.5:
        return cosine(u[0], u[1])
    d = u[0] * 2.0 * math.sin(0.5 * p.radius) ** 2
    s, phi = math.sqrt(d * (2.0 - d)), 2.0 * math.pi * u[1]
    return around(mirror(wo), s * math.cos(phi), s * math.sin(phi), 1.0 - d)


def pdf(wo, wi, p):
    disk = 0.25 / (math.pi * math.sin(0.5 * p.radius) ** 2) if inside(wo, wi, p.radius) else 0.0
    return 0.5 * wi[2] / math.pi + 0.5 * disk
