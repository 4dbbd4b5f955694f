"""Microfacet models: f = F(h.v) D(h) G/(4 mu_i mu_o), for every distribution, masking and Fresnel.

Cook & Torrance 1982 (normalisation "pi": division by pi instead of 4); Walter et al. 2007; Heitz
2014. Quadrature in the slope domain of formulas in slopes and cosines: no vector is formed, no
difference of large numbers taken, at any alpha and angle. V-cavity masking, Walter's rational fit
and total reflection have kinks, on which panels are split.
"""

import math
from typing import Any

from montecarlo_brdf.references import _fresnel, _kinks
from montecarlo_brdf.references import _microfacet as microfacet
from montecarlo_brdf.references._kinks import SMOOTH, Kinks
from montecarlo_brdf.references._quadrature import SOURCE, Geometry, check_cosine, slope_albedo
from montecarlo_brdf.references._rules import Array, hemispherical_mean, independent
from montecarlo_brdf.references._truth import Truth, sine

RECIPROCAL = True
ROUGH = 0.3  # alpha below which masking of light near the normal is far below rounding


def reflectance(x: Array, fresnel: str, f0: float, eta: float, k: float) -> Array | float:
    if fresnel == "schlick":
        return _fresnel.schlick(x, f0)
    if fresnel == "one":
        return 1.0
    return _fresnel.fresnel(x, eta, {"dielectric": 0.0, "conductor": k}[fresnel])


def _masking_kinks(distribution: str, masking: str, mu_o: float, alpha: float) -> Kinks:
    if masking == "v_cavity":
        return _kinks.v_cavity(mu_o)
    if masking.startswith("walter"):
        return _kinks.cosine(mu_o, microfacet.walter_cosine(alpha))
    if masking in ("smith", "separable") and distribution != "ggx" and alpha > ROUGH:
        return _kinks.light_at_normal(mu_o, sine(mu_o))  # Lambda is not analytic there
    return SMOOTH


def _critical_cosine(fresnel: str, eta: float, k: float) -> float | None:
    """h.v below which an index below 1 reflects totally; absorption k only rounds the kink off."""
    k = k if fresnel == "conductor" else 0.0
    square = 1.0 - (eta - k) * (eta + k)
    exact = fresnel in ("dielectric", "conductor") and eta < 1.0 and 0.0 < square < 1.0
    return math.sqrt(square) if exact else None


def integrate(
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
    d = microfacet.distribution(distribution, alpha, n)
    visibility = microfacet.MASKINGS[masking]
    divisor = {"4": 4.0, "pi": math.pi}[normalisation]

    def brdf(g: Geometry) -> Array:
        square = 1.0 + g.t * g.t
        density = d.p22(g.t) * square * square
        value = density * visibility(g, d) * reflectance(g.h_v, fresnel, f0, eta, k)
        return value / divisor

    check_cosine(mu_o)
    shadows = _masking_kinks(distribution, masking, mu_o, d.alpha)
    critical = _critical_cosine(fresnel, eta, k)
    total = _kinks.total_reflection(mu_o, critical) if critical else SMOOTH
    kinks = _kinks.together(shadows, total, sine(mu_o) / mu_o)
    width = microfacet.width_over_h_v(d, mu_o) if masking == "kelemen" else d.alpha
    return slope_albedo(brdf, mu_o, width=width, reach=d.reach, kinks=kinks)


def albedo(cos_theta_o: float, **parameters: Any) -> Truth:
    """See `integrate` for the keywords."""
    return independent(integrate(cos_theta_o, **parameters), SOURCE)


def bihemispherical(**parameters: Any) -> Truth:
    """See `integrate` for the keywords."""
    d = microfacet.distribution(
        parameters.get("distribution", "ggx"), parameters.get("alpha"), parameters.get("n")
    )
    fit_ends = (microfacet.walter_cosine(d.alpha),)
    breaks = {"v_cavity": (math.sqrt(0.5),), "walter": fit_ends, "walter_correlated": fit_ends}
    # with the masking of light at the normal not smooth, A is not smooth there either
    normal = (1.0,) if d.alpha > ROUGH else ()
    panels = breaks.get(parameters.get("masking", "smith"), normal)
    optics = (parameters.get(name, value) for name, value in (("eta", 1.5), ("k", 0.0)))
    critical = _critical_cosine(parameters.get("fresnel", "schlick"), *optics)
    panels = tuple(sorted({*panels, critical})) if critical else panels
    mean = hemispherical_mean(lambda mu: integrate(mu, **parameters), d.alpha, panels)
    return independent(mean, SOURCE)
