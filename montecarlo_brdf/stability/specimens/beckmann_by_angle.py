"""Beckmann with tan^2 of acos(n.h).

acos of a cosine near 1 has lost half its digits: in single precision it knows no angle between 0
and 0.0003. To ship: tan^2 = (x^2 + y^2)/z^2 of the unnormalised half vector, as `beckmann` does.
"""

from __future__ import annotations

import math

from montecarlo_brdf.stability.specimens.textbook_ggx import Params, domain, lobe
from montecarlo_brdf.vectors import Vec, half_vector


def density(n_h: float, alpha: float) -> float:
    """D(n.h)."""
    t = math.tan(math.acos(min(1.0, n_h))) / alpha
    c2 = n_h * n_h
    return math.exp(-t * t) / (math.pi * alpha * alpha * c2 * c2)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """D/(4 (h.v)^2), the masking of Kelemen and Szirmay-Kalos."""
    h = half_vector(wi, wo)
    c = h[0] * wo[0] + h[1] * wo[1] + h[2] * wo[2]
    return density(h[2], p.alpha) / (4.0 * c * c)
