"""GGX with 1e-6 added to its denominator, against a division by zero that cannot happen.

The bias outgrows d^2 = alpha^4 below alpha = 0.03: int D cos dw falls to 0.15 at roughness 0.1 and
0.0098 at roughness 0.05 (alpha = roughness^2). No precision helps. To ship: no guard; `ggx` divides
by a sum of squares.
"""

from __future__ import annotations

import math

from montecarlo_brdf.stability.specimens.textbook_ggx import (
    Params,
    domain,
    lobe,
    same_as,
    visibility,
)
from montecarlo_brdf.vectors import Vec, half_vector


def density(n_h: float, alpha: float) -> float:
    """D(n.h) with its guard."""
    a2 = alpha * alpha
    d = n_h * n_h * (a2 - 1.0) + 1.0
    return a2 / (math.pi * (d * d + 1e-6))


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """D G/(4 mu_i mu_o)."""
    return density(half_vector(wi, wo)[2], p.alpha) * visibility(wo, wi, p.alpha)
