"""Lafortune-Willems: f = kd/pi + ks (n+2)/(2 pi) (r.v)+^n.  Report CW197, K.U. Leuven, 1994."""

from montecarlo_brdf.references import phong
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, kd: float, ks: float, n: float) -> Truth:
    lobe = phong.albedo(cos_theta_o, ks=ks, n=n)
    return closed_form(kd + lobe.value, f"kd + {lobe.source}")


def bihemispherical(*, kd: float, ks: float, n: float) -> Truth:
    lobe = phong.bihemispherical(ks=ks, n=n)
    return closed_form(kd + lobe.value, f"kd + {lobe.source}")
