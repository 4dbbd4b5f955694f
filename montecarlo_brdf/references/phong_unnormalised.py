"""Phong's lobe used as a BRDF without its factor: f = ks (r.v)+^n, 2 pi/(n+2) times `phong`."""

import math

from montecarlo_brdf.references import phong
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True


def albedo(cos_theta_o: float, *, ks: float, n: float) -> Truth:
    return phong.albedo(cos_theta_o, ks=2.0 * math.pi / (n + 2.0) * ks, n=n)


def bihemispherical(*, ks: float, n: float) -> Truth:
    return phong.bihemispherical(ks=2.0 * math.pi / (n + 2.0) * ks, n=n)
