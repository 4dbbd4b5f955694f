"""Beckmann microfacets with exact height-correlated Smith masking and Schlick's Fresnel.

Beckmann & Spizzichino 1963; Walter et al. 2007; Heitz 2014. f0 = 1 means F = 1.
"""

from montecarlo_brdf.references import cook_torrance
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True


def albedo(cos_theta_o: float, *, alpha: float, f0: float) -> Truth:
    return cook_torrance.albedo(cos_theta_o, distribution="beckmann", alpha=alpha, f0=f0)


def bihemispherical(*, alpha: float, f0: float) -> Truth:
    return cook_torrance.bihemispherical(distribution="beckmann", alpha=alpha, f0=f0)
