"""A lobe blended into black through a diffuse middle that lacks 1/pi and is never drawn.

At blend = 0.6 A is above 2.

caught by: energy
cause: none
"""
import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    blend: float = 0.0


domain = {"ks": (0.0, 0.9), "blend": (0.0, 1.0)}
N = 2000.0


def mirror_cos(wo, wi):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] - wi[2]
    return max(0.0, 1.0 - 0.5 * (x * x + y * y + z * z))


def f(wo, wi, p):
    lobe = p.ks * (N + 2.0) / (2.0 * math.pi) * mirror_cos(wo, wi) ** N
    return 4.0 * p.blend * (1.0 - p.blend) * 0.8 + (1.0 - p.blend) ** 2 * lobe


def around(axis, x, y, z):
    a = 1.0 / (1.0 + axis[2])
    b = -axis[0] * axis[1] * a
    return (
        x * (1.0 - axis[0] * axis[0] * a) + y * b + z * axis[0],
        x * b + y * (1.0 - axis[1] * axis[1] * a) + z * axis[1],
        -x * axis[0] - y * axis[1] + z * axis[2],
    )


def sample(wo, u, p):
    c = (1.0 - u[0]) ** (1.0 / (N + 1.0))
    s = math.sqrt(max(0.0, 1.0 - c * c))
    phi = 2.0 * math.pi * u[1]
    return around((-wo[0], -wo[1], wo[2]), s * math.cos(phi), s * math.sin(phi), c)


def pdf(wo, wi, p):
    return (N + 1.0) / (2.0 * math.pi) * mirror_cos(wo, wi) ** N
