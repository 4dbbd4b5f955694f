"""Lobes of half vectors around the normal: a cosine power (Blinn-Phong, Ashikhmin-Shirley), or
Gaussian slopes (Ward, Kelemen & Szirmay-Kalos)."""
from __future__ import annotations

import math

from montecarlo_brdf.models._microfacet import half_power, half_sums, reflected
from montecarlo_brdf.special import exp, expm1, log1p, turn
from montecarlo_brdf.vectors import Vec


def sample_half_power(wo: Vec, u: Vec, n: float) -> Vec:
    """wo reflected by a half vector with n.h = (1 - u)^(1/(n+1)); may fall below the horizon."""
    d = -expm1(log1p(-u[0]) / (n + 1.0))
    s = math.sqrt(d * (2.0 - d))
    c1, s1 = turn(u[1])
    return reflected(wo, (s * c1, s * s1, 1.0 - d))


def half_power_pdf(wo: Vec, wi: Vec, n: float) -> float:
    """(n+1)/(2 pi) (n.h)^n/(4 h.v)."""
    h = half_sums(wo, wi)
    return (n + 1.0) / (4.0 * math.pi) * half_power(h, n) / math.sqrt(h[2])


def gaussian(h: Vec, alpha: float) -> float:
    """exp(-tan^2 theta_h/alpha^2)."""
    return exp(-h[0] / (h[1] * h[1] * alpha * alpha))


def sample_gaussian(wo: Vec, u: Vec, alpha: float) -> Vec:
    """wo reflected by a half vector with tan = alpha sqrt(-ln(1 - u)); may be rejected."""
    t = alpha * math.sqrt(-log1p(-u[0]))
    c, s = turn(u[1])
    return reflected(wo, (t * c, t * s, 1.0))


def gaussian_pdf(wo: Vec, wi: Vec, alpha: float) -> float:
    """exp(-tan^2/alpha^2)/(pi alpha^2 (n.h)^3 4 (h.v)), Walter 2005, eq. 9."""
    h = half_sums(wo, wi)
    z = h[1]
    return gaussian(h, alpha) * h[2] / (2.0 * math.pi * alpha * alpha * z * z * z)
