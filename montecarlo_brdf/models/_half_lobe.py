"""The cosine-power lobe of half vectors around the normal (Blinn-Phong, Ashikhmin-Shirley)."""
from __future__ import annotations

import math

from montecarlo_brdf.models._microfacet import half_power, half_sums, reflected
from montecarlo_brdf.special import expm1, log1p, turn
from montecarlo_brdf.vectors import Vec


def sample_half_power(wo: Vec, u: Vec, n: float) -> Vec:
    """wo reflected by a half vector with n.h = (1 - u)^(1/(n+1)); may fall below the horizon."""
    d = -expm1(log1p(-u[0]) / (n + 1.0))
    s = math.sqrt(d * (2.0 - d))
    c1, s1 = turn(u[1])
    return reflected(wo, (s * c1, s * s1, 1.0 - d))


def half_power_pdf(wo: Vec, wi: Vec, n: float) -> float:
    """(n+1)/(2 pi) (n.h)^n/(4 h.v)."""
    h = half_sums(wo, wi)
    return (n + 1.0) / (4.0 * math.pi) * half_power(h, n) / math.sqrt(h[2])
