"""Phong's lobe in its forms, by the moments of `_phong`: J_n of two axes, M_n of one.

phong               modified: f = ks (n+2)/(2 pi) (r.v)+^n. Lewis 1993; Lafortune & Willems 1994.
                    A is J_n; bihemispherical (2/3) ks (1 + B_n/(2 pi (n+2))).
lafortune_willems   f = kd/pi + the same. Report CW197, K.U. Leuven, 1994.
phong_unnormalised  the lobe without its factor: f = ks (r.v)+^n, 2 pi/(n+2) times `phong`.
phong_original      Phong 1975: L_o = ks N (r.v)^n L_i without the cosine, that is
                    f = ks N (r.v)+^n/mu_i; norm "n+1": N = (n+1)/(2 pi), "none": N = 1. Not
                    reciprocal: A is M_n, at most ks, while R(theta_i) = ks N J_n/mu_i grows
                    without bound at grazing light.
phong_unclamped     f = ks (n+2)/(2 pi) (r.v)^n of whole n without the clamp, by its parity. With
                    J(pi - theta) = J(theta) - 2 pi cos(theta)/(n+2) the half of the lobe below the
                    mirror direction's equator takes from the clamped albedo (odd), or adds to it
                    (even), J(pi - theta):

                        odd    A = ks cos(theta),    even   A = ks (2 (n+2)/(2 pi) J_n - cos(theta))

                    2 (n+2)/(2 pi) J_n - mu = mu I_{mu^2}(1/2, n/2+1) + B_n/pi s^(n+2), in positive
                    terms.
"""

import math

from montecarlo_brdf.references._phong import b_n, double_axis, mirrored_double_axis, single_axis
from montecarlo_brdf.references._truth import Albedos, Truth, closed_form


def _modified(mu: float, *, ks: float, n: float) -> Truth:
    value = ks * double_axis(mu, n)
    return closed_form(value, "Arvo 1995 / Lafortune-Willems 1994, double-axis moment")


def _mean_modified(*, ks: float, n: float) -> Truth:
    value = 2.0 / 3.0 * ks * (1.0 + b_n(n) / (2.0 * math.pi * (n + 2.0)))
    return closed_form(value, "(2/3) ks (1 + B_n/(2 pi (n+2)))")


def _on_diffuse(kd: float, lobe: Truth) -> Truth:
    return closed_form(kd + lobe.value, f"kd + {lobe.source}")


def _scale(ks: float, n: float, norm: str) -> float:
    """ks N, in units of the normalised (n+1)/(2 pi)."""
    return ks * {"n+1": 1.0, "none": 2.0 * math.pi / (n + 1.0)}[norm]


def _original(mu: float, *, ks: float, n: float, norm: str = "n+1") -> Truth:
    value = _scale(ks, n, norm) * single_axis(mu, n)
    return closed_form(value, "Arvo 1995, single-axis moment")


def _reverse_original(mu: float, *, ks: float, n: float, norm: str = "n+1") -> Truth:
    source = "Arvo 1995, double-axis moment over mu_i"
    if mu == 0.0:
        return Truth(math.inf, 0.0, "closed form", source)
    moment = (n + 1.0) / (n + 2.0) * double_axis(mu, n)
    return closed_form(_scale(ks, n, norm) * moment / mu, source)


def _mean_original(*, ks: float, n: float, norm: str = "n+1") -> Truth:
    value = _scale(ks, n, norm) * (2.0 * n + 3.0) / (2.0 * n + 4.0)
    return closed_form(value, "ks (2n+3)/(2n+4)")


def _unclamped(mu: float, *, ks: float, n: float, parity: str = "odd") -> Truth:
    if parity == "odd":
        return closed_form(ks * mu, "A = ks mu_o: odd moments of opposite axes")
    return closed_form(ks * mirrored_double_axis(mu, n), "A = ks ((n+2)/pi J_n - mu_o)")


def _mean_unclamped(*, ks: float, n: float, parity: str = "odd") -> Truth:
    more = 0.0 if parity == "odd" else b_n(n) / (math.pi * (n + 2.0))
    return closed_form(2.0 / 3.0 * ks * (1.0 + more), "2 int A mu dmu")


phong = Albedos(_modified, _mean_modified)
lafortune_willems = Albedos(
    lambda mu, *, kd, ks, n: _on_diffuse(kd, _modified(mu, ks=ks, n=n)),
    lambda *, kd, ks, n: _on_diffuse(kd, _mean_modified(ks=ks, n=n)),
)
phong_unnormalised = Albedos(
    lambda mu, *, ks, n: _modified(mu, ks=2.0 * math.pi / (n + 2.0) * ks, n=n),
    lambda *, ks, n: _mean_modified(ks=2.0 * math.pi / (n + 2.0) * ks, n=n),
)
phong_original = Albedos(_original, _mean_original, _reverse_original)
phong_unclamped = Albedos(_unclamped, _mean_unclamped)
