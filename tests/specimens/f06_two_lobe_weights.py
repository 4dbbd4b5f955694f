"""Failure 6. The sampler picks the lobe with probability 1/2, the pdf says 0.55."""

import math

from montecarlo_brdf.models import ggx
from montecarlo_brdf.models.ggx import Params, domain  # noqa: F401
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine

found_by = ("run", "sampling")
value, density, draw = ggx.f, ggx.pdf, ggx.sample


def f(wo, wi, p):
    return 0.5 * value(wo, wi, p) + 0.4 / math.pi


def sample(wo, u, p):
    if u[2] < 0.5:
        return draw(wo, u, p)
    return random_hemisphere_cosine(u[0], u[1])


def pdf(wo, wi, p):
    return 0.55 * density(wo, wi, p) + 0.45 * wi[2] / math.pi
