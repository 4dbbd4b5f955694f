"""Failure 27. D/(4 mu_i mu_o) without a masking term: grows without bound at grazing."""

from montecarlo_brdf.models._microfacet import ggx_density, half_sums
from montecarlo_brdf.models.ggx import Params, domain  # noqa: F401

found_by = ("run", "energy")


def f(wo, wi, p):
    return ggx_density(half_sums(wo, wi), p.alpha) / (4.0 * wi[2] * wo[2])
