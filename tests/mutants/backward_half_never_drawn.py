"""Lambert and a Phong lobe; the diffuse draws go to the mirror's side only, as the pdf says, and
no draw lies on the viewer's side but what the lobe throws there.

caught by: cover
cause: not drawn
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.5
    ks: float = 0.4
    n: float = 60.0


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5), "n": (20.0, 500.0)}


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


def lobe(axis, a, b, n):
    """A direction about `axis`, by a power of the cosine."""
    c = (1.0 - a) ** (1.0 / (n + 1.0))
    s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * b
    return around(axis, s * math.cos(phi), s * math.sin(phi), c)


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return p.kd / math.pi + p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n


def sample(wo, u, p):
    if u[2] < 0.5:
        return lobe(mirror(wo), u[0], u[1], p.n)
    r = math.sqrt(u[0])
    phi = math.atan2(-wo[1], -wo[0]) + math.pi * (u[1] - 0.5)
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    specular = (p.n + 1.0) / (2.0 * math.pi) * c**p.n
    side = -wo[0] * wi[0] - wo[1] * wi[1]
    if wo[0] == 0.0 and wo[1] == 0.0:
        side = -wi[0]
    diffuse = 2.0 * wi[2] / math.pi if side > 0.0 else 0.0
    return 0.5 * specular + 0.5 * diffuse
