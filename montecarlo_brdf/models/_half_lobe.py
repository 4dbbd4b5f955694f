"""Half vectors around the normal by a cosine power, for Blinn-Phong and Ashikhmin-Shirley."""
from __future__ import annotations

import math
from typing import Protocol

from montecarlo_brdf.models._microfacet import half_power, half_sums, reflected
from montecarlo_brdf.special import expm1, log1p, turn
from montecarlo_brdf.vectors import Vec


class Power(Protocol):
    """Parameters among which is the exponent."""

    @property
    def n(self) -> float: ...


def sample(wo: Vec, u: Vec, p: Power) -> Vec:
    """wo reflected by a half vector with n.h = (1 - u)^(1/(n+1)); may fall below the horizon."""
    d = -expm1(log1p(-u[0]) / (p.n + 1.0))
    s = math.sqrt(d * (2.0 - d))
    c1, s1 = turn(u[1])
    return reflected(wo, (s * c1, s * s1, 1.0 - d))


def pdf(wo: Vec, wi: Vec, p: Power) -> float:
    """(n+1)/(2 pi) (n.h)^n/(4 h.v)."""
    h = half_sums(wo, wi)
    return (p.n + 1.0) / (4.0 * math.pi) * half_power(h, p.n) / math.sqrt(h[2])
