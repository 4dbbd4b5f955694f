"""A Blinn lobe normalised in prepare() by 32 steps of the polar angle: enough for wide lobes, not
for exponents of some thousand.

suite: slow
caught by: energy
cause: normalisation
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 40.0


class Lobe(NamedTuple):
    n: float
    scale: float


domain = {"ks": (0.0, 0.95), "n": (1.0, 10000.0)}


def prepare(p):
    total, step = 0.0, 0.5 * math.pi / 32
    for k in range(32):
        t = (k + 0.5) * step
        total += 2.0 * math.pi * step * math.sin(t) * math.cos(t) * math.cos(t) ** p.n
    return Lobe(p.n, p.ks / total)


def f(wo, wi, p):
    c = max(0.0, wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1])
    return p.scale * c**p.n
