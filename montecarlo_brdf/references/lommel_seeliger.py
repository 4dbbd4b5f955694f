"""Lommel-Seeliger: f = albedo / (2 pi (mu_i + mu_o)).  Seeliger (1884); Hapke (2012), eq. 8.35.

    A = albedo (1 - mu_o ln(1 + 1/mu_o)),   bihemispherical albedo (4/3)(1 - ln 2).

With albedo 1 it equals the GGX microfacet model with alpha = 1, F = 1 and height-correlated Smith
masking. Well conditioned everywhere: the difference is never below 0.3.
"""

import math

from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, albedo: float) -> Truth:
    mu = cos_theta_o
    tail = mu * math.log1p(1.0 / mu) if mu > 0.0 else 0.0
    source = "A = albedo (1 - mu_o ln(1 + 1/mu_o))"
    return closed_form(albedo * (1.0 - tail), source, terms=albedo)


def bihemispherical(*, albedo: float) -> Truth:
    value = albedo * 4.0 / 3.0 * (1.0 - math.log(2.0))
    return closed_form(value, "albedo (4/3)(1 - ln 2)", terms=albedo)
