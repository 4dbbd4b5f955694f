"""GGX drawn by its visible normals: pdf is D/(4 wo.h), the density of neither these nor all
normals. f is right.

suite: slow
caught by: pdf
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.01, 1.0)}


def half(wo, wi):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    s = 1.0 / math.sqrt(x * x + y * y + z * z)
    return x * s, y * s, z * s


def d_ggx(h, a):
    t = (h[0] * h[0] + h[1] * h[1]) / (a * a) + h[2] * h[2]
    return 1.0 / (math.pi * a * a * t * t)


def vis(ci, co, a):
    a2 = a * a
    return 0.5 / (co * math.sqrt(a2 + (1 - a2) * ci * ci) + ci * math.sqrt(a2 + (1 - a2) * co * co))


def draw(wo, u, a):
    x, y, z = a * wo[0], a * wo[1], wo[2]
    s = 1.0 / math.sqrt(x * x + y * y + z * z)
    x, y, z = x * s, y * s, z * s
    q = x * x + y * y
    k = 1.0 / math.sqrt(q) if q > 0 else 0.0
    t1x, t1y = (-y * k, x * k) if q > 0 else (1.0, 0.0)
    t2x, t2y, t2z = -z * t1y, z * t1x, x * t1y - y * t1x
    r, phi = math.sqrt(u[0]), 2 * math.pi * u[1]
    a1, a2 = r * math.cos(phi), r * math.sin(phi)
    m = 0.5 * (1 + z)
    a2 = (1 - m) * math.sqrt(max(0.0, 1 - a1 * a1)) + m * a2
    a3 = math.sqrt(max(0.0, 1 - a1 * a1 - a2 * a2))
    hx, hy, hz = (
        a * (a1 * t1x + a2 * t2x + a3 * x),
        a * (a1 * t1y + a2 * t2y + a3 * y),
        max(1e-9, a2 * t2z + a3 * z),
    )
    s = 1.0 / math.sqrt(hx * hx + hy * hy + hz * hz)
    hx, hy, hz = hx * s, hy * s, hz * s
    d = 2 * (wo[0] * hx + wo[1] * hy + wo[2] * hz)
    return d * hx - wo[0], d * hy - wo[1], d * hz - wo[2]


def f(wo, wi, p):
    return d_ggx(half(wo, wi), p.alpha) * vis(wi[2], wo[2], p.alpha)


def sample(wo, u, p):
    return draw(wo, u, p.alpha)


def pdf(wo, wi, p):
    h = half(wo, wi)
    return d_ggx(h, p.alpha) / (4 * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]))
