"""GGX with the denominator kept above 1e-3, against a division by zero that cannot happen.

pi d^2 is about pi alpha^4 at the peak: below 1e-3 for alpha < 0.13, so the highlight is cut off.
int D cos dw falls to 0.70, 0.17, 0.011 at roughness 0.3, 0.2, 0.1 (alpha = roughness^2). No
precision helps. To ship: no guard; `ggx` divides by a sum of squares.
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
    return a2 / max(math.pi * d * d, 1e-3)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """D G/(4 mu_i mu_o)."""
    return density(half_vector(wi, wo)[2], p.alpha) * visibility(wo, wi, p.alpha)
