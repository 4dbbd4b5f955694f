"""Failure 7. The density of the half vector returned for that of wi: 1/(4 wo.h) is missing."""

import math

from montecarlo_brdf.models import blinn_phong
from montecarlo_brdf.models._microfacet import half_power, half_sums

found_by = ("run", "pdf")
draw = blinn_phong.sample
Params = blinn_phong.Params
domain = {"ks": (0.0, 1.0), "n": (0.0, 1000.0)}


def f(wo, wi, p):
    return p.ks * (p.n + 2.0) / (8.0 * math.pi) * half_power(half_sums(wo, wi), p.n)


def sample(wo, u, p):
    return draw(wo, u, p)


def pdf(wo, wi, p):
    return (p.n + 1.0) / (2.0 * math.pi) * half_power(half_sums(wo, wi), p.n)
