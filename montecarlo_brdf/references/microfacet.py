"""Microfacet models: f = F(h.v) D(h) G/(4 mu_i mu_o), for every distribution, masking and Fresnel.

cook_torrance         Cook & Torrance 1982 (normalisation "pi": division by pi instead of 4); Walter
                      et al. 2007; Heitz 2014. Quadrature in the slope domain of formulas in slopes
                      and cosines: no vector is formed, no difference of large numbers taken, at any
                      alpha and angle. V-cavity masking, Walter's rational fit and total reflection
                      have kinks, on which panels are split.
beckmann              exact height-correlated Smith masking and Schlick's Fresnel. Beckmann &
                      Spizzichino 1963; Walter et al. 2007; Heitz 2014.
kelemen_szirmay_kalos f = D F/(4 (h.v)^2), Beckmann D, Schlick F. Eurographics 2001.
schlick_ggx           Schlick's masking mu/(mu (1-k) + k); Karis, SIGGRAPH course 2013.
                      k = "direct": (sqrt(alpha) + 1)^2/8; k = "ibl": alpha/2.
ggx                   Walter et al. 2007; Heitz 2014. F = 1 (f0 = 1) by the 1-D integral of `_ggx`.
ggx_kulla_conty       SIGGRAPH course 2017, slides 14-20: f = f_ss + c (1 - E(mu_i))(1 - E(mu_o))/
                      (pi (1 - mean E)), c = Fa^2 mean E/(1 - Fa (1 - mean E)) and
                      Fa = f0 + (1 - f0)/21 the mean of Schlick's Fresnel, so
                      A = A_ss + c (1 - E). f0 = 1: A = 1 exactly.
ggx_turquin           2019, eq. 10: f = f_ss (1 + f0 (1 - E(mu_o))/E(mu_o)), so A = A_ss (1 + f0
                      (1 - E)/E), exactly 1 for f0 = 1. The factor knows only the view, so f is not
                      reciprocal: R(theta_i) = integral f_ss (1 - f0 + f0/E(mu_o)) mu_o dwo
                      exceeds 1.
"""

import math
from functools import partial
from typing import Any

from montecarlo_brdf.references import _kinks
from montecarlo_brdf.references import _microfacet as facets
from montecarlo_brdf.references._ggx import (
    TABLE_ERROR,
    mean_albedo,
    unit_albedo,
    unit_albedo_table,
)
from montecarlo_brdf.references._kinks import SMOOTH, Kinks
from montecarlo_brdf.references._quadrature import SOURCE, Geometry, check_cosine, slope_albedo
from montecarlo_brdf.references._rules import Array, hemispherical_mean, independent
from montecarlo_brdf.references._truth import EPSILON, Albedos, Truth, closed_form, sine

ROUGH = 0.3  # alpha below which masking of light near the normal is far below rounding
UNIT_SOURCE = "1-D quadrature, azimuth in closed form"
SCALED_SOURCE = "A_ss (1 + f0 (1 - E)/E), both by quadrature"
BY_SUM, BY_QUOTIENT = "1 by construction: E + (1 - E)", "1 by construction: E/E"


def _reflectance(x: Array, fresnel: str, f0: float, eta: float, k: float) -> Array | float:
    if fresnel == "schlick":
        return facets.schlick(x, f0)
    if fresnel == "one":
        return 1.0
    return facets.fresnel(x, eta, {"dielectric": 0.0, "conductor": k}[fresnel])


def _masking_kinks(distribution: str, masking: str, mu_o: float, alpha: float) -> Kinks:
    if masking == "v_cavity":
        return _kinks.v_cavity(mu_o)
    if masking.startswith("walter"):
        return _kinks.cosine(mu_o, facets.walter_cosine(alpha))
    if masking in ("smith", "separable") and distribution != "ggx" and alpha > ROUGH:
        return _kinks.light_at_normal(mu_o, sine(mu_o))  # Lambda is not analytic there
    return SMOOTH


def _critical_cosine(fresnel: str, eta: float, k: float) -> float | None:
    """h.v below which an index below 1 reflects totally; absorption k only rounds the kink off."""
    k = k if fresnel == "conductor" else 0.0
    square = 1.0 - (eta - k) * (eta + k)
    exact = fresnel in ("dielectric", "conductor") and eta < 1.0 and 0.0 < square < 1.0
    return math.sqrt(square) if exact else None


def _integrate(
    mu_o: float,
    *,
    distribution: str = "ggx",
    masking: str = "smith",
    fresnel: str = "schlick",
    normalisation: str = "4",
    alpha: float | None = None,
    n: float | None = None,
    f0: float = 1.0,
    eta: float = 1.5,
    k: float = 0.0,
) -> tuple[float, float]:
    """The albedo and the bound on its error."""
    d = facets.distribution(distribution, alpha, n)
    visibility = facets.MASKINGS[masking]
    divisor = {"4": 4.0, "pi": math.pi}[normalisation]

    def brdf(g: Geometry) -> Array:
        square = 1.0 + g.t * g.t
        density = d.p22(g.t) * square * square
        value = density * visibility(g, d) * _reflectance(g.h_v, fresnel, f0, eta, k)
        return value / divisor

    check_cosine(mu_o)
    shadows = _masking_kinks(distribution, masking, mu_o, d.alpha)
    critical = _critical_cosine(fresnel, eta, k)
    total = _kinks.total_reflection(mu_o, critical) if critical else SMOOTH
    kinks = _kinks.together(shadows, total, sine(mu_o) / mu_o)
    width = facets.width_over_h_v(d, mu_o) if masking == "kelemen" else d.alpha
    return slope_albedo(brdf, mu_o, width=width, reach=d.reach, kinks=kinks)


def _albedo(mu: float, **parameters: Any) -> Truth:
    """See `_integrate` for the keywords."""
    return independent(_integrate(mu, **parameters), SOURCE)


def _mean(**parameters: Any) -> Truth:
    """See `_integrate` for the keywords."""
    d = facets.distribution(
        parameters.get("distribution", "ggx"), parameters.get("alpha"), parameters.get("n")
    )
    fit_ends = (facets.walter_cosine(d.alpha),)
    breaks = {"v_cavity": (math.sqrt(0.5),), "walter": fit_ends, "walter_correlated": fit_ends}
    # with the masking of light at the normal not smooth, A is not smooth there either
    normal = (1.0,) if d.alpha > ROUGH else ()
    panels = breaks.get(parameters.get("masking", "smith"), normal)
    optics = (parameters.get(name, value) for name, value in (("eta", 1.5), ("k", 0.0)))
    critical = _critical_cosine(parameters.get("fresnel", "schlick"), *optics)
    panels = tuple(sorted({*panels, critical})) if critical else panels
    mean = hemispherical_mean(lambda mu: _integrate(mu, **parameters), d.alpha, panels)
    return independent(mean, SOURCE)


def _ggx(mu: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return independent(unit_albedo(mu, alpha), UNIT_SOURCE)
    return _albedo(mu, alpha=alpha, f0=f0)


def _mean_ggx(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return independent(mean_albedo(alpha), UNIT_SOURCE)
    return _mean(alpha=alpha, f0=f0)


def _compensated(single: Truth, unit: tuple[float, float], alpha: float, f0: float) -> Truth:
    """A_ss + c (1 - E)."""
    fresnel, mean = f0 + (1.0 - f0) / 21.0, mean_albedo(alpha)[0]
    colour = fresnel * fresnel * mean / (1.0 - fresnel * (1.0 - mean))
    # the colour is below 1 and moves at most as much as the mean of E, which E's bound covers
    error = single.error + 2.0 * unit[1] + 8.0 * EPSILON
    value = single.value + colour * (1.0 - unit[0])
    return independent((value, error), "A_ss + c (1 - E), both by quadrature")


def _kulla_conty(mu: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, BY_SUM)
    return _compensated(_ggx(mu, alpha=alpha, f0=f0), unit_albedo(mu, alpha), alpha, f0)


def _mean_kulla_conty(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, BY_SUM)
    return _compensated(_mean_ggx(alpha=alpha, f0=f0), mean_albedo(alpha), alpha, f0)


def _scaled(mu: float, alpha: float, f0: float) -> tuple[float, float]:
    """A_ss (1 + f0 (1 - E)/E)."""
    single, (unit, unit_error) = _ggx(mu, alpha=alpha, f0=f0), unit_albedo(mu, alpha)
    value = single.value * (1.0 - f0 + f0 / unit)
    relative = single.error / single.value + unit_error / unit + 4.0 * EPSILON
    return value, value * relative


def _turquin(mu: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, BY_QUOTIENT)
    return independent(_scaled(mu, alpha, f0), SCALED_SOURCE)


def _mean_turquin(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, BY_QUOTIENT)
    return independent(hemispherical_mean(lambda mu: _scaled(mu, alpha, f0), alpha), SCALED_SOURCE)


def _reverse_turquin(mu: float, *, alpha: float, f0: float) -> Truth:
    d = facets.ggx(alpha)

    def brdf(g: Geometry) -> Array:
        """f with the light fixed: the integration variable g.mu_i is the view's cosine."""
        single = d.p22(g.t) / (4.0 * g.h_n**4) * facets.smith(g, d)
        single *= facets.schlick(g.h_v, f0)
        return single * (1.0 - f0 + f0 / unit_albedo_table(g.mu_i, alpha))

    value, error = slope_albedo(brdf, mu, width=alpha)
    source = "quadrature in half-vector slopes, E(mu_o) tabulated by 1-D quadrature"
    return independent((value, error + TABLE_ERROR * value), source)


def _with(**parts: Any) -> Albedos:
    """Cook & Torrance's model with some parts picked."""
    return Albedos(partial(_albedo, **parts), partial(_mean, **parts))


cook_torrance = _with()
beckmann = _with(distribution="beckmann")
kelemen_szirmay_kalos = _with(distribution="beckmann", masking="kelemen")
schlick_ggx = Albedos(
    lambda mu, *, k="direct", **p: _albedo(mu, masking=f"schlick_k_{k}", **p),
    lambda *, k="direct", **p: _mean(masking=f"schlick_k_{k}", **p),
)
ggx = Albedos(_ggx, _mean_ggx)
ggx_kulla_conty = Albedos(_kulla_conty, _mean_kulla_conty)
ggx_turquin = Albedos(_turquin, _mean_turquin, _reverse_turquin)
