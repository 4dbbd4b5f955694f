"""Needles of 0.001 at the mirror direction and at wo, one of the two drawn by u[2], half each."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.4


domain = {"ks": (0.0, 0.45)}
W2 = 0.001**2


def bell(a, b):
    x, y, z = a[0] - b[0], a[1] - b[1], a[2] - b[2]
    return math.exp(-0.5 * (x * x + y * y + z * z) / W2) / (2.0 * math.pi * W2)


def mirror(w):
    return -w[0], -w[1], w[2]


def f(wo, wi, p):
    return p.ks * (bell(wo, wi) + bell(mirror(wo), wi)) / max(wo[2], wi[2])


def around(axis, x, y, z):
    a = 1.0 / (1.0 + axis[2])
    b = -axis[0] * axis[1] * a
    v = (
        x * (1.0 - axis[0] * axis[0] * a) + y * b + z * axis[0],
        x * b + y * (1.0 - axis[1] * axis[1] * a) + z * axis[1],
        -x * axis[0] - y * axis[1] + z * axis[2],
    )
    n = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return v[0] / n, v[1] / n, v[2] / n


def sample(wo, u, p):
    d = -W2 * math.log(1.0 - u[0])  # 1 - cos
    s, phi = math.sqrt(max(0.0, d * (2.0 - d))), 2.0 * math.pi * u[1]
    x, y = s * math.cos(phi), s * math.sin(phi)
    if u[2] < 0.5:
        return around(wo, x, y, 1.0 - d)
    return around(mirror(wo), x, y, 1.0 - d)


def pdf(wo, wi, p):
    return 0.5 * (bell(wo, wi) + bell(mirror(wo), wi))
