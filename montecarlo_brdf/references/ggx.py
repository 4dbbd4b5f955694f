"""GGX microfacets with height-correlated Smith masking and Schlick's Fresnel (f0 = 1: F = 1).

Walter et al. 2007; Heitz 2014. F = 1 by the 1-D integral of `_ggx`, else in the slope domain.
"""

from montecarlo_brdf.references import cook_torrance
from montecarlo_brdf.references._ggx import mean_albedo, unit_albedo
from montecarlo_brdf.references._rules import independent
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True
SOURCE = "1-D quadrature, azimuth in closed form"


def albedo(cos_theta_o: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return independent(unit_albedo(cos_theta_o, alpha), SOURCE)
    return cook_torrance.albedo(cos_theta_o, alpha=alpha, f0=f0)


def bihemispherical(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return independent(mean_albedo(alpha), SOURCE)
    return cook_torrance.bihemispherical(alpha=alpha, f0=f0)
