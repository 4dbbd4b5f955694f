"""A von Mises-Fisher lobe about the mirror direction, kappa from 0.001 to 100,000 by expm1 and
log1p.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9
    kappa: float = 20.0


domain = {"albedo": (0.0, 1.0), "kappa": (1e-3, 1e5)}


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


def apart(wo, wi):
    """1 - cos of the angle to the mirror direction, by differences that keep their digits."""
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] - wi[2]
    return 0.5 * (x * x + y * y + z * z)


def lobe(wo, wi, k):
    return -k / (2.0 * math.pi * math.expm1(-2.0 * k)) * math.exp(-k * apart(wo, wi))


def f(wo, wi, p):
    return p.albedo * lobe(wo, wi, p.kappa)


def sample(wo, u, p):
    d = -math.log1p(u[0] * math.expm1(-2.0 * p.kappa)) / p.kappa
    s, phi = math.sqrt(max(0.0, d * (2.0 - d))), 2.0 * math.pi * u[1]
    return around((-wo[0], -wo[1], wo[2]), s * math.cos(phi), s * math.sin(phi), 1.0 - d)


def pdf(wo, wi, p):
    return lobe(wo, wi, p.kappa)
