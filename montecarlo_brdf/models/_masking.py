"""Masking and shadowing as G/(mu_i mu_o), which stays finite at the horizon where G does.

h = (t2, z, l2) of `half_sums`, mu = (mu_o, mu_i), hidden = mu Lambda of either direction, alpha the
width of the distribution (sqrt(2/(n+2)) for Blinn-Phong).
"""
from __future__ import annotations

import math

from montecarlo_brdf.vectors import Vec

Pair = tuple[float, float]


def smith(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """1/(1 + Lambda_o + Lambda_i), height-correlated: Heitz 2014, eq. 99."""
    return 1.0 / (mu[0] * mu[1] + mu[1] * hidden[0] + mu[0] * hidden[1])


def separable(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """1/((1 + Lambda_o)(1 + Lambda_i)): Walter et al. 2007, eq. 23."""
    return 1.0 / ((mu[0] + hidden[0]) * (mu[1] + hidden[1]))


def v_cavity(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """min(1, 2 (n.h) min(mu_o, mu_i)/(h.v)): Torrance & Sparrow 1967; Cook & Torrance 1982."""
    return min(1.0, 4.0 * h[1] * min(mu[0], mu[1]) / h[2]) / (mu[0] * mu[1])


def walter_g1(mu: float, alpha: float) -> float:
    """G1/mu by the fit of Walter et al. 2007, eq. 27: 1/mu from mu = 1.6 alpha sin."""
    side = alpha * math.sqrt((1.0 - mu) * (1.0 + mu))
    top = 3.535 * side + 2.181 * mu
    fit = top / (side * side + 2.276 * side * mu + 2.577 * mu * mu)
    return fit if mu < 1.6 * side else 1.0 / mu


def walter(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """Separable, with the rational fit of Beckmann's G1: Walter et al. 2007, eq. 27."""
    return walter_g1(mu[0], alpha) * walter_g1(mu[1], alpha)


def walter_correlated(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """1/(1/G1_o + 1/G1_i - 1), height-correlated, with the rational fit of Beckmann's G1."""
    o, i = walter_g1(mu[0], alpha), walter_g1(mu[1], alpha)
    return o * i / (mu[1] * i + mu[0] * o - mu[0] * mu[1] * (o * i))


def kelemen(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """mu_o mu_i/(h.v)^2: Kelemen & Szirmay-Kalos 2001, eq. 6."""
    return 4.0 / h[2]


def implicit(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """mu_o mu_i: the denominator cancels."""
    return 1.0


def none(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """1: nothing is masked, and grazing light is reflected without bound."""
    return 1.0 / (mu[0] * mu[1])


def schlick_k(mu: Pair, k: float) -> float:
    """mu/(mu (1 - k) + k) for either direction: Schlick 1994."""
    return 1.0 / ((mu[0] * (1.0 - k) + k) * (mu[1] * (1.0 - k) + k))


def schlick_k_direct(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """k = (sqrt(alpha) + 1)^2/8: Karis 2013, eq. 4, for point lights."""
    return schlick_k(mu, 0.125 * (math.sqrt(alpha) + 1.0) * (math.sqrt(alpha) + 1.0))


def schlick_k_ibl(h: Vec, mu: Pair, hidden: Pair, alpha: float) -> float:
    """k = alpha/2: Karis 2013, for environments."""
    return schlick_k(mu, 0.5 * alpha)
