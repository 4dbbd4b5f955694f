"""Microfacet models: f = F(h.v) D(h) G/(4 mu_i mu_o), for every distribution, masking and Fresnel.

Cook & Torrance 1982 (normalisation "pi": division by pi instead of 4); Walter et al. 2007; Heitz
2014. Quadrature in the slope domain of formulas in slopes and cosines: no vector is formed, no
difference of large numbers taken, at any alpha and angle. V-cavity masking and Walter's rational
fit have kinks, on which panels are split.
"""

import math
from typing import Any

import numpy as np

from montecarlo_brdf.references import _fresnel
from montecarlo_brdf.references import _microfacet as microfacet
from montecarlo_brdf.references._bihemispherical import hemispherical_mean
from montecarlo_brdf.references._quadrature import Geometry, slope_albedo
from montecarlo_brdf.references._rules import Array, independent
from montecarlo_brdf.references._truth import Truth, sine

RECIPROCAL = True
ROUGH = 0.3  # alpha below which masking of light near the normal is far below rounding
SOURCE = "quadrature in half-vector slopes fitted to the horizon"


def reflectance(x: Array, fresnel: str, f0: float, eta: float, k: float) -> Array | float:
    if fresnel == "schlick":
        return _fresnel.schlick(x, f0)
    if fresnel == "one":
        return 1.0
    return _fresnel.fresnel(x, eta, {"dielectric": 0.0, "conductor": k}[fresnel])


def _kinks(distribution: str, masking: str, mu_o: float, alpha: float) -> dict[str, Any]:
    """Where f is not smooth, for `slope_albedo`."""
    if masking == "v_cavity":
        return {
            "kinks": microfacet.v_cavity_kinks,
            "azimuth_break": 1.0 if mu_o * mu_o < 0.5 else None,
        }
    if masking.startswith("walter"):
        mu = microfacet.walter_cosine(alpha)
        turn = math.sqrt(max((mu - mu_o) * (mu + mu_o), 0.0)) / mu_o
        return {"kinks": microfacet.cosine_kinks(mu_o, mu), "azimuth_break": turn or None}
    if masking in ("smith", "separable") and distribution != "ggx" and alpha > ROUGH:
        # Lambda is not analytic where the light is at the normal, t = tan(theta_o/2), phi = 0
        half = sine(mu_o) / (1.0 + mu_o)
        return {"kinks": lambda k: (np.full_like(k, half),), "azimuth_break": math.inf}
    return {}


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

    kinks = _kinks(distribution, masking, mu_o, d.alpha)
    return slope_albedo(brdf, mu_o, width=d.alpha, reach=d.reach, **kinks)


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
    mean = hemispherical_mean(lambda mu: integrate(mu, **parameters), d.alpha, panels)
    return independent(mean, SOURCE)
