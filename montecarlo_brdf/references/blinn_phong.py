"""Blinn-Phong: f = ks N (n.h)^n.  Blinn 1977.

norm "n+2": N = (n+2)/(8 pi); "n+8": (n+8)/(8 pi) (Hoffman et al. 2008); "exact":
(n+2)(n+4)/(8 pi (2^(-n/2) + n)), which makes A(0) = ks (Giesen 2009); "none": 1.
Off normal there is no closed form: quadrature in the slope domain.
"""

import math

import numpy as np

from montecarlo_brdf.references import _microfacet as microfacet
from montecarlo_brdf.references._quadrature import SOURCE, Geometry, slope_albedo
from montecarlo_brdf.references._rules import Array, hemispherical_mean, independent
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True


def _scale(n: float, norm: str) -> float:
    exact = (n + 2.0) * (n + 4.0) / (2.0 ** (-0.5 * n) + n)
    return {"n+2": n + 2.0, "n+8": n + 8.0, "exact": exact, "none": 8.0 * math.pi}[norm]


def _integrate(mu_o: float, ks: float, n: float, norm: str) -> tuple[float, float]:
    scale, d = ks * _scale(n, norm) / (8.0 * math.pi), microfacet.blinn_phong(n)

    def brdf(g: Geometry) -> Array:
        return scale * np.exp(-0.5 * n * np.log1p(g.t * g.t))

    return slope_albedo(brdf, mu_o, width=d.alpha, reach=d.reach)


def albedo(cos_theta_o: float, *, ks: float, n: float, norm: str = "n+2") -> Truth:
    return independent(_integrate(cos_theta_o, ks, n, norm), SOURCE)


def bihemispherical(*, ks: float, n: float, norm: str = "n+2") -> Truth:
    width = math.sqrt(2.0 / (n + 2.0))
    return independent(hemispherical_mean(lambda mu: _integrate(mu, ks, n, norm), width), SOURCE)
