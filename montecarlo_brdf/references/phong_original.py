"""Phong 1975: L_o = ks N (r.v)^n L_i without the cosine, that is f = ks N (r.v)+^n/mu_i.

norm "n+1": N = (n+1)/(2 pi); "none": N = 1.  Not reciprocal: A is the single-axis moment, at most
ks, while R(theta_i) = ks N J_n/mu_i grows without bound at grazing light.
"""

import math

from montecarlo_brdf.references._phong import double_axis, single_axis
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = False


def _scale(ks: float, n: float, norm: str) -> float:
    """ks N, in units of the normalised (n+1)/(2 pi)."""
    return ks * {"n+1": 1.0, "none": 2.0 * math.pi / (n + 1.0)}[norm]


def albedo(cos_theta_o: float, *, ks: float, n: float, norm: str = "n+1") -> Truth:
    value = _scale(ks, n, norm) * single_axis(cos_theta_o, n)
    return closed_form(value, "Arvo 1995, single-axis moment")


def reverse_albedo(cos_theta_i: float, *, ks: float, n: float, norm: str = "n+1") -> Truth:
    source = "Arvo 1995, double-axis moment over mu_i"
    if cos_theta_i == 0.0:
        return Truth(math.inf, 0.0, "closed form", source)
    moment = (n + 1.0) / (n + 2.0) * double_axis(cos_theta_i, n)
    return closed_form(_scale(ks, n, norm) * moment / cos_theta_i, source)


def bihemispherical(*, ks: float, n: float, norm: str = "n+1") -> Truth:
    value = _scale(ks, n, norm) * (2.0 * n + 3.0) / (2.0 * n + 4.0)
    return closed_form(value, "ks (2n+3)/(2n+4)")
