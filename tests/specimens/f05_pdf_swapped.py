"""Failure 5. The pdf of a visible-normal sampler called with wo and wi exchanged."""

from montecarlo_brdf.models import ggx
from montecarlo_brdf.models.ggx import Params, domain, f, sample  # noqa: F401

found_by = ("run", "pdf")
density = ggx.pdf


def pdf(wo, wi, p):
    return density(wi, wo, p)
