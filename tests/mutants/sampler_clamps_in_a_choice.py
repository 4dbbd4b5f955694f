"""GGX on Lambert, one of them by u[2]; the sampler clamps alpha to at least 0.05, f and pdf do not.

caught by: pdf
cause: none
"""
import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half(wo, wi):
    return norm((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def density(h, a):
    t2 = (h[0] * h[0] + h[1] * h[1]) / (a * a)
    k = h[2] * h[2] + t2
    return 1.0 / (math.pi * a * a * k * k)


def lam(w, a):
    t2 = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + a * a * t2) - 1.0)


def masking(wo, wi, a):
    return 1.0 / (1.0 + lam(wo, a) + lam(wi, a))


def refl(wo, h):
    k = 2.0 * dot(wo, h)
    return norm((k * h[0] - wo[0], k * h[1] - wo[1], k * h[2] - wo[2]))


def vndf_sample(wo, u, a):
    v = norm((a * wo[0], a * wo[1], wo[2]))
    phi = 2.0 * math.pi * u[0]
    z = (1.0 - u[1]) * (1.0 + v[2]) - v[2]
    s = math.sqrt(max(0.0, 1.0 - z * z))
    h = (s * math.cos(phi) + v[0], s * math.sin(phi) + v[1], z + v[2])
    return refl(wo, norm((a * h[0], a * h[1], max(h[2], 1e-12))))


def vndf_pdf(wo, wi, a):
    h = half(wo, wi)
    return density(h, a) / (4.0 * wo[2] * (1.0 + lam(wo, a)))


domain = {"alpha": (0.02, 0.9)}


def f(wo, wi, p):
    lobe = density(half(wo, wi), p.alpha) * masking(wo, wi, p.alpha) / (4.0 * wo[2] * wi[2])
    return 0.5 * lobe + 0.4 / math.pi


def sample(wo, u, p):
    if u[2] < 0.5:
        return vndf_sample(wo, u, max(p.alpha, 0.05))
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return 0.5 * vndf_pdf(wo, wi, p.alpha) + 0.5 * wi[2] / math.pi
