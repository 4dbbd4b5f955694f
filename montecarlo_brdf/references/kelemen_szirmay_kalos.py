"""Kelemen & Szirmay-Kalos, Eurographics 2001: f = D F/(4 (h.v)^2), Beckmann D, Schlick F."""

from montecarlo_brdf.references import cook_torrance
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True
CHOICES = {"distribution": "beckmann", "masking": "kelemen"}


def albedo(cos_theta_o: float, *, alpha: float, f0: float) -> Truth:
    return cook_torrance.albedo(cos_theta_o, **CHOICES, alpha=alpha, f0=f0)


def bihemispherical(*, alpha: float, f0: float) -> Truth:
    return cook_torrance.bihemispherical(**CHOICES, alpha=alpha, f0=f0)
