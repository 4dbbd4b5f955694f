"""Fujii's variant of qualitative Oren-Nayar, without the dark ring at cos(dphi) < 0.

f = albedo/pi (A + B s/t)  [1/sr]
s = wi.wo - mu_i mu_o,  t = max(mu_i, mu_o) if s > 0 else 1,
A = 1 - sigma^2/(2 (sigma^2 + 0.33)) + 0.17 albedo sigma^2/(sigma^2 + 0.13),
B = 0.45 sigma^2/(sigma^2 + 0.09)

Sampling: cosine-weighted.
albedo: of the facets, 0 to 1.  sigma: standard deviation of the facets' slope angle, radians,
0 to pi/2; 0 is Lambert.
Source: Fujii, "A tiny improvement of Oren-Nayar reflectance model" (web page).
Violates: energy conservation for albedo > 0.97352: 1.028703 at grazing, sigma = 0.2575.
"""
from __future__ import annotations

import math

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.models.fon import tangential_ratio
from montecarlo_brdf.models.oren_nayar import Params, domain, kinks, limits, verified
from montecarlo_brdf.vectors import Vec

disclaims = {"energy": "albedo 1 reflects up to 1.028703 at grazing (sigma = 0.2575)"}


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """albedo/pi (A + B s/t)."""
    s2 = p.sigma * p.sigma
    a = 1.0 - 0.5 * s2 / (s2 + 0.33) + 0.17 * p.albedo * s2 / (s2 + 0.13)
    b = 0.45 * s2 / (s2 + 0.09)
    return p.albedo / math.pi * (a + b * tangential_ratio(wo, wi))
