"""Fujii's Oren-Nayar (FON), the footnote version: f = albedo/pi A_F (1 + r s/t), roughness r.

A_F = 1/(1 + (1/2 - 2/(3 pi)) r).  Fujii 2012; Portsmouth, Kutz & Hill, JCGT 14(1) 2025, eqs. 5-12.
Its directional albedo over `albedo` is E_F = A_F (1 + r G_F/pi), exactly 1 at grazing.
"""

import math

from montecarlo_brdf.references._oren_nayar import MEAN_G_FUJII, g_fujii
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def _a(roughness: float) -> float:
    return 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


def unit_albedo(mu: float, roughness: float) -> float:
    """E_F: the albedo of a white surface."""
    return _a(roughness) * (1.0 + roughness / math.pi * g_fujii(mu))


def unit_mean(roughness: float) -> float:
    """The bihemispherical mean of E_F."""
    return _a(roughness) * (1.0 + MEAN_G_FUJII * roughness)


def albedo(cos_theta_o: float, *, albedo: float, roughness: float) -> Truth:
    value = albedo * unit_albedo(cos_theta_o, roughness)
    return closed_form(value, "A = albedo A_F (1 + r G_F/pi), EON paper 2025", terms=albedo)


def bihemispherical(*, albedo: float, roughness: float) -> Truth:
    value = albedo * unit_mean(roughness)
    return closed_form(value, "albedo A_F (1 + (2/3 - 28/(15 pi)) r)", terms=albedo)
