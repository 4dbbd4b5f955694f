"""Oren-Nayar as rewritten by Fujii ("A tiny improvement of Oren-Nayar", 2012), qualitative form.

f = albedo/pi (A + B s/t), s = wi.wo - mu_i mu_o, t = max(mu_i, mu_o) if s > 0 else 1, with the
interreflection of Oren & Nayar folded into A = A1 + 0.17 albedo sigma^2/(sigma^2 + 0.13).
Well conditioned at every angle.
"""

import math

from montecarlo_brdf.references._oren_nayar import MEAN_G_FUJII, constants, g_fujii
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def _constants(albedo: float, sigma: float) -> tuple[float, float]:
    a, b = constants(sigma)
    return a + 0.17 * albedo * sigma * sigma / (sigma * sigma + 0.13), b


def albedo(cos_theta_o: float, *, albedo: float, sigma: float) -> Truth:
    a, b = _constants(albedo, sigma)
    value = albedo * (a + b / math.pi * g_fujii(cos_theta_o))
    terms = albedo * (a + b)
    return closed_form(value, "A = albedo (A + B G_F(theta_o)/pi), Fujii 2012", terms=terms)


def bihemispherical(*, albedo: float, sigma: float) -> Truth:
    a, b = _constants(albedo, sigma)
    value = albedo * (a + b * MEAN_G_FUJII)
    return closed_form(value, "albedo (A + B (2/3 - 28/(15 pi)))", terms=albedo * (a + b))
