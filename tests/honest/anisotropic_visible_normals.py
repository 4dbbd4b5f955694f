"""Anisotropic GGX with Schlick's Fresnel, drawn by its visible normals (Heitz 2018).

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ax: float = 0.3
    ay: float = 0.1
    f0: float = 0.9


domain = {"ax": (0.02, 1.0), "ay": (0.02, 1.0), "f0": (0.0, 1.0)}
isotropic = False


def distribution(hx, hy, hz, ax, ay):
    t = (hx / ax) ** 2 + (hy / ay) ** 2 + hz * hz
    return 1.0 / (math.pi * ax * ay * t * t)


def lam(v, ax, ay):
    t = ((ax * v[0]) ** 2 + (ay * v[1]) ** 2) / (v[2] * v[2])
    return 0.5 * (math.sqrt(1.0 + t) - 1.0)


def half(wo, wi):
    hx, hy, hz = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    n = 1.0 / math.sqrt(hx * hx + hy * hy + hz * hz)
    return hx * n, hy * n, hz * n


def f(wo, wi, p):
    hx, hy, hz = half(wo, wi)
    voh = wo[0] * hx + wo[1] * hy + wo[2] * hz
    F = p.f0 + (1.0 - p.f0) * (1.0 - voh) ** 5
    G = 1.0 / (1.0 + lam(wo, p.ax, p.ay) + lam(wi, p.ax, p.ay))
    return distribution(hx, hy, hz, p.ax, p.ay) * G * F / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):

    vx, vy, vz = p.ax * wo[0], p.ay * wo[1], wo[2]
    n = 1.0 / math.sqrt(vx * vx + vy * vy + vz * vz)
    vx, vy, vz = vx * n, vy * n, vz * n
    l2 = vx * vx + vy * vy
    if l2 > 0.0:
        il = 1.0 / math.sqrt(l2)
        t1x, t1y, t1z = -vy * il, vx * il, 0.0
    else:
        t1x, t1y, t1z = 1.0, 0.0, 0.0
    t2x = vy * t1z - vz * t1y
    t2y = vz * t1x - vx * t1z
    t2z = vx * t1y - vy * t1x
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    a = r * math.cos(phi)
    b = r * math.sin(phi)
    s = 0.5 * (1.0 + vz)
    b = (1.0 - s) * math.sqrt(max(0.0, 1.0 - a * a)) + s * b
    c = math.sqrt(max(0.0, 1.0 - a * a - b * b))
    hx = p.ax * (a * t1x + b * t2x + c * vx)
    hy = p.ay * (a * t1y + b * t2y + c * vy)
    hz = max(0.0, a * t1z + b * t2z + c * vz)
    n = 1.0 / math.sqrt(hx * hx + hy * hy + hz * hz)
    hx, hy, hz = hx * n, hy * n, hz * n
    d = 2.0 * (wo[0] * hx + wo[1] * hy + wo[2] * hz)
    return d * hx - wo[0], d * hy - wo[1], d * hz - wo[2]


def pdf(wo, wi, p):
    hx, hy, hz = half(wo, wi)
    G1 = 1.0 / (1.0 + lam(wo, p.ax, p.ay))
    return G1 * distribution(hx, hy, hz, p.ax, p.ay) / (4.0 * wo[2])
