"""GGX as it is printed: D of n.h, with (n.h)^2 (alpha^2 - 1) + 1.

Near n.h = 1 the sum is about alpha^2 and keeps an error of one rounding of 1: D is wrong by
2 eps/alpha^2, 12 % in single precision at alpha = 0.001. To ship: alpha |H|^2/(alpha^2 z^2 + x^2 +
y^2) of the unnormalised half vector, as `ggx` does, or |n x h|^2 for 1 - (n.h)^2 (Filament, 4.4.1).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.vectors import Vec, half_vector


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (1e-4, 1.0)}
lobe = ("half vector", lambda p: p.alpha)
same_as = "ggx"


def density(n_h: float, alpha: float) -> float:
    """D(n.h)."""
    a2 = alpha * alpha
    d = n_h * n_h * (a2 - 1.0) + 1.0
    return a2 / (math.pi * d * d)


def visibility(wo: Vec, wi: Vec, alpha: float) -> float:
    """G/(4 mu_i mu_o), height-correlated Smith."""
    a2 = alpha * alpha
    i = wo[2] * math.sqrt(wi[2] * wi[2] * (1.0 - a2) + a2)
    o = wi[2] * math.sqrt(wo[2] * wo[2] * (1.0 - a2) + a2)
    return 0.5 / (i + o)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """D G/(4 mu_i mu_o)."""
    return density(half_vector(wi, wo)[2], p.alpha) * visibility(wo, wi, p.alpha)
