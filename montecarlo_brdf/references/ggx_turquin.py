"""GGX with Turquin's compensation (2019): f = f_ss (1 + f0 (1 - E(mu_o))/E(mu_o)), eq. 10.

A = A_ss (1 + f0 (1 - E)/E), exactly 1 for f0 = 1. The factor knows only the view, so f is not
reciprocal: R(theta_i) = integral f_ss (1 - f0 + f0/E(mu_o)) mu_o dwo exceeds 1.
"""

from montecarlo_brdf.references import _fresnel, ggx
from montecarlo_brdf.references import _microfacet as microfacet
from montecarlo_brdf.references._ggx import TABLE_ERROR, unit_albedo, unit_albedo_table
from montecarlo_brdf.references._quadrature import Geometry, slope_albedo
from montecarlo_brdf.references._rules import Array, hemispherical_mean, independent
from montecarlo_brdf.references._truth import EPSILON, Truth, closed_form

RECIPROCAL = False
EXACT = "1 by construction: E/E"
SOURCE = "A_ss (1 + f0 (1 - E)/E), both by quadrature"


def _directional(mu: float, alpha: float, f0: float) -> tuple[float, float]:
    single, (unit, unit_error) = ggx.albedo(mu, alpha=alpha, f0=f0), unit_albedo(mu, alpha)
    value = single.value * (1.0 - f0 + f0 / unit)
    relative = single.error / single.value + unit_error / unit + 4.0 * EPSILON
    return value, value * relative


def albedo(cos_theta_o: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, EXACT)
    return independent(_directional(cos_theta_o, alpha, f0), SOURCE)


def bihemispherical(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, EXACT)
    return independent(hemispherical_mean(lambda mu: _directional(mu, alpha, f0), alpha), SOURCE)


def reverse_albedo(cos_theta_i: float, *, alpha: float, f0: float) -> Truth:
    d = microfacet.ggx(alpha)

    def brdf(g: Geometry) -> Array:
        """f with the light fixed: the integration variable g.mu_i is the view's cosine."""
        single = d.p22(g.t) / (4.0 * g.h_n**4) * microfacet.smith(g, d)
        single *= _fresnel.schlick(g.h_v, f0)
        return single * (1.0 - f0 + f0 / unit_albedo_table(g.mu_i, alpha))

    value, error = slope_albedo(brdf, cos_theta_i, width=alpha)
    source = "quadrature in half-vector slopes, E(mu_o) tabulated by 1-D quadrature"
    return independent((value, error + TABLE_ERROR * value), source)
