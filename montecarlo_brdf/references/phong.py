"""Modified Phong: f = ks (n+2)/(2 pi) (r.v)+^n.  Lewis 1993; Lafortune & Willems 1994.

A is the double-axis moment of `_phong`; bihemispherical (2/3) ks (1 + B_n/(2 pi (n+2))).
"""

import math

from montecarlo_brdf.references._phong import b_n, double_axis
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, ks: float, n: float) -> Truth:
    value = ks * double_axis(cos_theta_o, n)
    return closed_form(value, "Arvo 1995 / Lafortune-Willems 1994, double-axis moment")


def bihemispherical(*, ks: float, n: float) -> Truth:
    value = 2.0 / 3.0 * ks * (1.0 + b_n(n) / (2.0 * math.pi * (n + 2.0)))
    return closed_form(value, "(2/3) ks (1 + B_n/(2 pi (n+2)))")
