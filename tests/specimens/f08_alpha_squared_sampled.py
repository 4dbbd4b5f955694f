"""Failure 8. The sampler squares a width that is alpha already."""

from montecarlo_brdf.models._microfacet import sample_visible
from montecarlo_brdf.models.ggx import Params, domain, f, pdf  # noqa: F401

found_by = ("run", "sampling")


def sample(wo, u, p):
    return sample_visible(wo, u, p.alpha * p.alpha, p.alpha * p.alpha)
