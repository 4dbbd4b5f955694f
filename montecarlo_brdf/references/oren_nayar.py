"""Oren-Nayar, qualitative: f = albedo/pi (A1 + B max(0, cos dphi) sin a tan b).

Oren & Nayar, SIGGRAPH 1994, eq. 30. A = albedo (A1 + B G(theta_o)/pi) with G of `_oren_nayar`.
Well conditioned at every angle.
"""

import math

from montecarlo_brdf.references._oren_nayar import MEAN_G, constants, g_qualitative
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, albedo: float, sigma: float) -> Truth:
    a, b = constants(sigma)
    value = albedo * (a + b / math.pi * g_qualitative(cos_theta_o))
    return closed_form(value, "A = albedo (A1 + B G(theta_o)/pi), Oren-Nayar 1994 integrated")


def bihemispherical(*, albedo: float, sigma: float) -> Truth:
    a, b = constants(sigma)
    return closed_form(albedo * (a + b * MEAN_G), "albedo (A1 + B (2/3 - 64/(45 pi)))")
