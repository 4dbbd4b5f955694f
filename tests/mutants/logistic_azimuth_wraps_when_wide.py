"""Hair's logistic azimuth about the mirror side, cut off at 180 degrees and scaled up; for widths
beyond 0.7 the sampler wraps what lies beyond instead.

suite: slow
caught by: pdf
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    s: float = 0.3


domain = {"albedo": (0.0, 1.0), "s": (0.05, 1.5)}


def logistic(x, s):
    e = math.exp(-abs(x) / s)
    inside = math.tanh(0.5 * math.pi / s)
    return e / (s * (1.0 + e) ** 2) / inside


def turned(wo, wi):
    """Azimuth of wi about that of the mirror direction, -pi to pi."""
    d = math.atan2(wi[1], wi[0]) - math.atan2(-wo[1], -wo[0])
    return math.atan2(math.sin(d), math.cos(d))


def f(wo, wi, p):
    sines = math.sqrt((1.0 - wo[2] * wo[2]) * (1.0 - wi[2] * wi[2]))
    k = 2.0 * math.pi * logistic(turned(wo, wi), p.s) - 1.0
    return p.albedo / math.pi * (1.0 + sines * k)


def drawn(u, s):
    if s > 0.7:
        return s * (math.log(max(u, 1e-16)) - math.log(1.0 - u))
    a = 1.0 / (1.0 + math.exp(math.pi / s))
    v = a + u * (1.0 - 2.0 * a)
    return s * math.log(v / (1.0 - v))


def sample(wo, u, p):
    phi = 2.0 * math.pi * u[1]
    if u[2] >= 0.5:
        phi = math.atan2(-wo[1], -wo[0]) + drawn(u[1], p.s)
    r = math.sqrt(u[0])
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] * (0.5 / math.pi + logistic(turned(wo, wi), p.s))
