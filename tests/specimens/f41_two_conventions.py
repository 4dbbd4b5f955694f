"""Failure 41. D takes alpha, G takes its square root for the same parameter."""

import math

from montecarlo_brdf.models._microfacet import ggx_density, half_sums, stretched
from montecarlo_brdf.models.ggx import Params, domain, lobe  # noqa: F401

found_by = ("run", "equality")
same_as = "ggx"


def f(wo, wi, p):
    a = math.sqrt(p.alpha)
    masked = wi[2] * stretched(wo, a) + wo[2] * stretched(wi, a)
    return p.f0 * ggx_density(half_sums(wo, wi), p.alpha) * 0.5 / masked
