"""Light and dark fields over the hemisphere, 8 rings by 12 sectors, for viewer and light alike: f
jumps along every edge.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    light: float = 0.9
    dark: float = 0.1


domain = {"light": (0.0, 1.0), "dark": (0.0, 1.0)}
isotropic = False


def tint(w, p):
    ring = int(8.0 * w[2] * w[2])
    sector = int(12.0 * (math.atan2(w[1], w[0]) / (2.0 * math.pi) + 0.5))
    return p.light if (ring + sector) % 2 == 0 else p.dark


def f(wo, wi, p):
    return tint(wo, p) * tint(wi, p) / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    w = (r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0]))
    return w[0], w[1], w[2], tint(wo, p) * tint(w, p)
