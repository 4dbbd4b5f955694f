"""Failure 44. min(1, f) clips the highlight."""

from montecarlo_brdf.models import ggx
from montecarlo_brdf.models.ggx import Params, domain, lobe  # noqa: F401

found_by = ("run", "equality")
value = ggx.f
same_as = "ggx"


def f(wo, wi, p):
    return min(1.0, value(wo, wi, p))
