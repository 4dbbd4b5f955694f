"""Fibres along x with three lobes of different tilts; the sampler and its pdf know only the outer
two, f has the light through the middle too.

suite: slow
caught by: cover
cause: not drawn
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    r: float = 0.3
    tt: float = 0.3
    trt: float = 0.3
    width: float = 0.05


domain = {"r": (0.0, 0.33), "tt": (0.0, 0.33), "trt": (0.0, 0.33), "width": (0.02, 0.3)}
isotropic = False


def bell(x, w):
    return math.exp(-0.5 * (x / w) ** 2) / (w * math.sqrt(2.0 * math.pi))


def f(wo, wi, p):
    x = wo[0] + wi[0]
    return 0.5 * (
        p.r * bell(x - 0.35, p.width) + p.tt * bell(x, p.width) + p.trt * bell(x + 0.35, p.width)
    )


def sample(wo, u, p):
    tilt, v = (0.35, 2.0 * u[2]) if u[2] < 0.5 else (-0.35, 2.0 * u[2] - 1.0)
    bend = math.sqrt(-2.0 * math.log(1.0 - u[0])) * math.cos(2.0 * math.pi * u[1])
    x = tilt - wo[0] + p.width * bend
    if abs(x) >= 1.0:
        return 0.0, 0.0, -1.0
    y = (2.0 * v - 1.0) * math.sqrt(1.0 - x * x)
    return x, y, math.sqrt(max(0.0, 1.0 - x * x - y * y))


def pdf(wo, wi, p):
    x = wo[0] + wi[0]
    along = 0.5 * bell(x - 0.35, p.width) + 0.5 * bell(x + 0.35, p.width)
    return along * 0.5 * wi[2] / math.sqrt(wi[1] * wi[1] + wi[2] * wi[2])
