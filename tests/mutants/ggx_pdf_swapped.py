"""wo and wi are swapped in the pdf of visible normals.

caught by: pdf
cause: swapped directions
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.02, 1.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def reflect(v, n):
    k = 2.0 * dot(v, n)
    return k * n[0] - v[0], k * n[1] - v[1], k * n[2] - v[2]


def half_vector(wo, wi):
    return normalize((wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]))


def distribution(h, alpha):
    a2 = alpha * alpha
    d = h[2] * h[2] * (a2 - 1.0) + 1.0
    return a2 / (math.pi * d * d)


def smith_lambda(w, alpha):
    tan2 = (1.0 - w[2] * w[2]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + alpha * alpha * tan2) - 1.0)


def masking(wo, wi, alpha):
    return 1.0 / (1.0 + smith_lambda(wo, alpha) + smith_lambda(wi, alpha))


def f(wo, wi, p):
    h = half_vector(wo, wi)
    d = distribution(h, p.alpha)
    g = masking(wo, wi, p.alpha)
    return d * g / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    v = normalize((p.alpha * wo[0], p.alpha * wo[1], wo[2]))
    length2 = v[0] * v[0] + v[1] * v[1]
    t1 = (1.0, 0.0, 0.0)
    if length2 > 0.0:
        t1 = (-v[1] / math.sqrt(length2), v[0] / math.sqrt(length2), 0.0)
    t2 = (-v[2] * t1[1], v[2] * t1[0], v[0] * t1[1] - v[1] * t1[0])
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1]
    a = r * math.cos(phi)
    b = r * math.sin(phi)
    s = 0.5 * (1.0 + v[2])
    b = (1.0 - s) * math.sqrt(1.0 - a * a) + s * b
    c = math.sqrt(max(0.0, 1.0 - a * a - b * b))
    x = a * t1[0] + b * t2[0] + c * v[0]
    y = a * t1[1] + b * t2[1] + c * v[1]
    z = b * t2[2] + c * v[2]
    h = normalize((p.alpha * x, p.alpha * y, max(0.0, z)))
    return reflect(wo, h)


def pdf(wo, wi, p):
    h = half_vector(wo, wi)
    g1 = 1.0 / (1.0 + smith_lambda(wi, p.alpha))
    visible = g1 * dot(wo, h) * distribution(h, p.alpha) / wi[2]
    return visible / (4.0 * dot(wo, h))
