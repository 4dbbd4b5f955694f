"""Failure 35. A glossy lobe times pi in an albedo output: values far above 1."""

import math

from montecarlo_brdf.models import ggx
from montecarlo_brdf.models.ggx import Params, domain, lobe, pdf, sample  # noqa: F401

found_by = ("run", "energy")
value = ggx.f


def f(wo, wi, p):
    return math.pi * value(wo, wi, p)
