"""Failure 38. Blinn-Phong with Phong's normalisation (n+2)/(2 pi)."""

import math

from montecarlo_brdf.models import blinn_phong
from montecarlo_brdf.models._microfacet import half_power, half_sums

found_by = ("run", "energy")
draw, density = blinn_phong.sample, blinn_phong.pdf
Params = blinn_phong.Params
domain = {"ks": (0.0, 1.0), "n": (0.0, 1000.0)}


def f(wo, wi, p):
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * half_power(half_sums(wo, wi), p.n)


def sample(wo, u, p):
    return draw(wo, u, p)


def pdf(wo, wi, p):
    return density(wo, wi, p)
