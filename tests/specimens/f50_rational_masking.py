"""Failure 50.

Walter's rational fit of Beckmann masking where the exact one is declared: 0.3 % off.
"""

import math

from montecarlo_brdf.models._microfacet import beckmann_density, half_sums
from montecarlo_brdf.models.beckmann import Params, domain, lobe  # noqa: F401

found_by = ("run", "equality")
same_as = "beckmann"


def shadowing(w, alpha):
    s2 = w[0] * w[0] + w[1] * w[1]
    a = w[2] / (alpha * math.sqrt(s2)) if s2 > 0.0 else 1e9
    return (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) if a < 1.6 else 0.0


def f(wo, wi, p):
    masked = 1.0 + shadowing(wi, p.alpha) + shadowing(wo, p.alpha)
    return p.f0 * beckmann_density(half_sums(wo, wi), p.alpha) / (4.0 * wi[2] * wo[2] * masked)
