"""The spherical cap of visible normals is cut 2 % too low.

caught by: pdf
cause: normalisation
"""

import math
from typing import NamedTuple


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.02, 1.0)}


def distribution(h, alpha):
    a2 = alpha * alpha
    t = h[2] * h[2] * (a2 - 1.0) + 1.0
    return a2 / (math.pi * t * t)


def smith_lambda(w, alpha):
    c2 = w[2] * w[2]
    return 0.5 * (math.sqrt(1.0 + alpha * alpha * (1.0 - c2) / c2) - 1.0)


def masking(wo, wi, alpha):
    return 1.0 / (1.0 + smith_lambda(wo, alpha) + smith_lambda(wi, alpha))


def f(wo, wi, p):
    h = half_vector(wo, wi)
    return distribution(h, p.alpha) * masking(wo, wi, p.alpha) / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    a = p.alpha
    v = normalize((a * wo[0], a * wo[1], wo[2]))
    phi = 2.0 * math.pi * u[0]
    z = (1.0 - u[1]) * (1.0 + 0.98 * v[2]) - 0.98 * v[2]
    s = math.sqrt(max(0.0, 1.0 - z * z))
    c = (s * math.cos(phi), s * math.sin(phi), z)
    h = normalize((a * (c[0] + v[0]), a * (c[1] + v[1]), c[2] + v[2]))
    d = dot(wo, h)
    return 2.0 * d * h[0] - wo[0], 2.0 * d * h[1] - wo[1], 2.0 * d * h[2] - wo[2]


def pdf(wo, wi, p):
    h = half_vector(wo, wi)
    return distribution(h, p.alpha) / (4.0 * wo[2] * (1.0 + smith_lambda(wo, p.alpha)))
