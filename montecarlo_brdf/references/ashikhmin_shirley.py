"""Ashikhmin & Shirley, "An anisotropic Phong BRDF model", JGT 5(2) 2000, with n_u = n_v = n.

    f = 28 rd/(23 pi) (1 - rs) (1 - (1 - mu_i/2)^5)(1 - (1 - mu_o/2)^5)                 (eq. 5)
        + (n+1)/(8 pi) (n.h)^n F(h.v)/((h.v) max(mu_i, mu_o)),  F Schlick's with rs     (eq. 4)

The diffuse part has A = rd (1 - rs)(1 - (1 - mu_o/2)^5); the rest is quadrature, with panels split
at mu_i = mu_o.
"""

import math

import numpy as np

from montecarlo_brdf.references import _fresnel
from montecarlo_brdf.references import _microfacet as microfacet
from montecarlo_brdf.references._kinks import Kinks
from montecarlo_brdf.references._quadrature import Geometry, slope_albedo
from montecarlo_brdf.references._rules import Array, hemispherical_mean, independent
from montecarlo_brdf.references._truth import EPSILON, Truth

RECIPROCAL = True
SOURCE = "closed diffuse part + quadrature in half-vector slopes"


def _specular(mu_o: float, rs: float, n: float) -> tuple[float, float]:
    d = microfacet.blinn_phong(n)

    def brdf(g: Geometry) -> Array:
        lobe = (n + 1.0) / (8.0 * math.pi) * np.exp(-0.5 * n * np.log1p(g.t * g.t))
        return lobe * _fresnel.schlick(g.h_v, rs) / (g.h_v * np.maximum(g.mu_i, g.mu_o))

    # equal cosines at t = k, until that is beyond the lobe
    breaks = (0.0, d.reach) if d.reach < 1.0 else (0.0,)
    equal = Kinks(lambda k: (np.maximum(k, 0.0),), 1, breaks)
    return slope_albedo(brdf, mu_o, width=d.alpha, reach=d.reach, kinks=equal)


def _sum(diffuse: float, specular: tuple[float, float]) -> Truth:
    return independent((diffuse + specular[0], specular[1] + 16.0 * EPSILON * diffuse), SOURCE)


def albedo(cos_theta_o: float, *, rd: float, rs: float, n: float) -> Truth:
    # 1 - (1 - x)^5 without cancellation, x = mu_o/2
    polynomial = -math.expm1(5.0 * math.log1p(-0.5 * cos_theta_o))
    return _sum(rd * (1.0 - rs) * polynomial, _specular(cos_theta_o, rs, n))


def bihemispherical(*, rd: float, rs: float, n: float) -> Truth:
    width = math.sqrt(2.0 / (n + 2.0))
    # mu_i = mu_o cuts the lobe in half but within `width` of the normal, where 1 - mu = width^2/2
    closer = [1.0 - 4.0 * width * width * 16.0**k for k in range(16)]
    breaks = sorted(mu for mu in closer if mu > 0.75)
    specular = hemispherical_mean(lambda mu: _specular(mu, rs, n), width, (*breaks, 1.0))
    return _sum(23.0 / 28.0 * rd * (1.0 - rs), specular)
