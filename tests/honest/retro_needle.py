"""A needle about wo on a diffuse base, drawn by a sampler that knows both."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    kd: float = 0.3
    ks: float = 0.4


domain = {"kd": (0.0, 0.5), "ks": (0.0, 0.5)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


W2 = 0.01 ** 2


def lobe(wo, wi):
    x, y, z = wo[0] - wi[0], wo[1] - wi[1], wo[2] - wi[2]
    bell = math.exp(-0.5 * (x * x + y * y + z * z) / W2)
    return bell / (2.0 * math.pi * W2 * (1.0 - math.exp(-2.0 / W2)))


def f(wo, wi, p):
    return p.kd / math.pi + p.ks * lobe(wo, wi) / max(wo[2], wi[2])


def sample(wo, u, p):
    if u[2] < 0.5:
        c = max(-1.0, 1.0 + W2 * math.log(1.0 - u[0]))
        s, phi = math.sqrt(max(0.0, 1.0 - c * c)), 2.0 * math.pi * u[1]
        t = norm((0.0, wo[2], -wo[1]))
        b = (wo[1] * t[2] - wo[2] * t[1], wo[2] * t[0] - wo[0] * t[2], wo[0] * t[1] - wo[1] * t[0])
        x, y = s * math.cos(phi), s * math.sin(phi)
        turned = [x * t[k] + y * b[k] + c * wo[k] for k in range(3)]
        return norm(turned)
    return cosine(u)


def pdf(wo, wi, p):
    return 0.5 * lobe(wo, wi) + 0.5 * wi[2] / math.pi
