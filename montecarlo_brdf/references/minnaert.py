"""Minnaert: f = (albedo/pi) (mu_i mu_o)^(k-1).  Minnaert, Astrophys. J. 93 (1941).

    A = 2 albedo mu_o^(k-1) / (k+1),   bihemispherical 4 albedo / (k+1)^2,   both for k > -1.

Conditioning: a relative change of mu_o changes A by |k-1| times as much. That is harmless for the
cosine itself, but an angle in radians near 90 degrees loses digits when its cosine is taken
(1e-16/mu_o relative): take sin(90 degrees - theta) instead. For k < 1 A is infinite at mu_o = 0.
"""

import math

from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, albedo: float, k: float) -> Truth:
    source = "A = 2 albedo mu_o^(k-1)/(k+1) (Minnaert 1941, integrated)"
    if k <= -1.0 or (cos_theta_o == 0.0 and k < 1.0):
        return Truth(math.inf if albedo else 0.0, 0.0, "closed form", source)
    value = 2.0 * albedo * cos_theta_o ** (k - 1.0) / (k + 1.0)
    # k-1 is rounded, and its error is multiplied by the logarithm of the cosine
    slack = abs(k - 1.0) + abs(math.log(cos_theta_o or 1.0)) * (1.0 + abs(k))
    return closed_form(value, source, condition=slack)


def bihemispherical(*, albedo: float, k: float) -> Truth:
    source = "4 albedo/(k+1)^2"
    if k <= -1.0:
        return Truth(math.inf if albedo else 0.0, 0.0, "closed form", source)
    return closed_form(4.0 * albedo / (k + 1.0) ** 2, source)
