"""What microfacet models share: half-vector sums, distributions, masking, Fresnel, sampling.

All is written in the unnormalised half vector H = wi + wo with (t2, z, l2) = (Hx^2 + Hy^2, Hz,
|H|^2), because then nothing cancels:

    tan^2 theta_h = t2/z^2     n.h = z/|H|     h.v = |H|/2     1 - n.h = t2/(|H| (|H| + z))

Near the mirror direction Hx and Hy are exact differences, so a lobe of width alpha = 0.001 keeps
its digits, where 1 - (n.h)^2 would lose six of them.
"""
from __future__ import annotations

import math
from typing import Protocol

from montecarlo_brdf.special import exp, log1p, turn
from montecarlo_brdf.vectors import Vec


class Facets(Protocol):
    """Parameters among which are those of GGX."""

    @property
    def alpha(self) -> float: ...

    @property
    def f0(self) -> float: ...


def half_sums(wo: Vec, wi: Vec) -> Vec:
    """(t2, z, l2) of H = wi + wo."""
    x, y, z = wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]
    t2 = x * x + y * y
    return t2, z, t2 + z * z


def ggx_density(h: Vec, alpha: float) -> float:
    """D = alpha^2/(pi cos^4 (alpha^2 + tan^2)^2), Walter et al. 2007, eq. 33."""
    t2, z, l2 = h
    q = alpha * l2 / (alpha * alpha * z * z + t2)
    return q * q / math.pi


def beckmann_density(h: Vec, alpha: float) -> float:
    """D = exp(-tan^2/alpha^2)/(pi alpha^2 cos^4), Walter et al. 2007, eq. 25."""
    t2, z, l2 = h
    q = l2 / (z * z * alpha)
    return exp(-t2 / (z * z * alpha * alpha)) * q * q / math.pi


def half_power(h: Vec, n: float) -> float:
    """(n.h)^n = (1 + tan^2)^(-n/2)."""
    t2, z, _ = h
    return exp(-0.5 * n * log1p(t2 / (z * z)))


def stretched(w: Vec, alpha: float) -> float:
    """S = sqrt(cos^2 + alpha^2 sin^2), in terms of which GGX's Lambda = (S/cos - 1)/2."""
    return math.sqrt(w[2] * w[2] + alpha * alpha * (w[0] * w[0] + w[1] * w[1]))


def ggx_reflection(h: Vec, wo: Vec, wi: Vec, alpha: float) -> float:
    """D G/(4 mu_i mu_o) with height-correlated Smith masking (Heitz 2014, eq. 99), as one quotient.

    G/(4 mu_i mu_o) = 1/(2 (mu_i S_o + mu_o S_i)) is finite at the horizon. The quotient is used
    twice, or the compiler would draw the Fresnel factor into it and divide once per channel.
    """
    t2, z, l2 = h
    a2 = alpha * alpha
    q = a2 * z * z + t2
    masked = wi[2] * stretched(wo, alpha) + wo[2] * stretched(wi, alpha)
    r = 1.0 / (q * masked)
    return 0.5 / math.pi * (l2 * l2) * (a2 * (r * masked)) * r  # in this order in range of single


def schlick(h: Vec, f0: float) -> float:
    """F = f0 + (1 - f0)(1 - h.v)^5, Schlick 1994, eq. 15."""
    c = 1.0 - 0.5 * math.sqrt(h[2])
    c2 = c * c
    return f0 + (1.0 - f0) * (c2 * c2 * c)


def sample_visible(wo: Vec, u: Vec, alpha_x: float, alpha_y: float) -> Vec:
    """wo reflected by a GGX facet as seen from wo; z <= 0 where the light is masked.

    Source: Dupuy & Benyoub 2023, "Sampling visible GGX normals with spherical caps". The cap's
    1 - cos and 1 + cos are both formed as sums of positive terms, so neither pole cancels.
    """
    x, y, z = alpha_x * wo[0], alpha_y * wo[1], wo[2]
    side2 = x * x + y * y
    scale = 1.0 / math.sqrt(side2 + z * z)
    x, y, z = x * scale, y * scale, z * scale
    above = (1.0 - u[0]) * (1.0 + z)
    below = side2 * scale * scale / (1.0 + z)
    r = math.sqrt(u[0] * (1.0 + z) * (above + below))
    c, s = turn(u[1])
    return reflected(wo, (alpha_x * (r * c + x), alpha_y * (r * s + y), above))


def reflected(wo: Vec, m: Vec) -> Vec:
    """2 (wo.m) m/|m|^2 - wo, for a facet normal m of any length."""
    k = 2.0 * (wo[0] * m[0] + wo[1] * m[1] + wo[2] * m[2])
    k = k / (m[0] * m[0] + m[1] * m[1] + m[2] * m[2])
    return k * m[0] - wo[0], k * m[1] - wo[1], k * m[2] - wo[2]
