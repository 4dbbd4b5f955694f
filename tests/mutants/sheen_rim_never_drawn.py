"""Velvet that shines where both directions graze; the sampler stops at 84 degrees, against weights
that are too large, and its pdf agrees.

suite: slow
caught by: cover
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.1
    sheen: float = 0.7


domain = {"base": (0.0, 0.3), "sheen": (0.0, 0.7)}


def f(wo, wi, p):
    rim = ((1.0 - wo[2]) * (1.0 - wi[2])) ** 3
    return (p.base + 8.0 * p.sheen * rim) / math.pi


def sample(wo, u, p):
    z = math.sqrt(1.0 - 0.99 * u[0])
    s, phi = math.sqrt(max(0.0, 1.0 - z * z)), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    return wi[2] / (0.99 * math.pi) if wi[2] > 0.1 else 0.0
