"""Beckmann as it is printed: exp((c^2 - 1)/(alpha^2 c^2)) of c = n.h.

c^2 - 1 cancels near the normal: the exponent is wrong by eps/alpha^2. To ship: tan^2 = (x^2 +
y^2)/z^2 of the unnormalised half vector, as `beckmann` does.
"""

from __future__ import annotations

import math

from montecarlo_brdf.stability.specimens.textbook_ggx import Params, domain, lobe
from montecarlo_brdf.vectors import Vec, half_vector


def density(n_h: float, alpha: float) -> float:
    """D(n.h)."""
    c2 = n_h * n_h
    a2 = alpha * alpha
    return math.exp((c2 - 1.0) / (a2 * c2)) / (math.pi * a2 * c2 * c2)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """D/(4 (h.v)^2), the masking of Kelemen and Szirmay-Kalos."""
    h = half_vector(wi, wo)
    c = h[0] * wo[0] + h[1] * wo[1] + h[2] * wo[2]
    return density(h[2], p.alpha) / (4.0 * c * c)
