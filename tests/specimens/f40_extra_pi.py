"""Failure 40. Oren-Nayar divided by pi twice."""

import math

from montecarlo_brdf.models import oren_nayar
from montecarlo_brdf.models.oren_nayar import Params, domain  # noqa: F401

found_by = ("run", "equality")
value = oren_nayar.f
same_as = "oren_nayar"


def f(wo, wi, p):
    return value(wo, wi, p) / math.pi
