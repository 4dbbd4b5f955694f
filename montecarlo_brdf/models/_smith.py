"""Smith masking beyond GGX, as mu Lambda(mu), which stays finite at the horizon.

With x^2 = a exponent of the distribution:

    Beckmann      mu Lambda = (alpha sin/sqrt(pi) exp(-x^2) - mu erfc(x))/2,  x = mu/(alpha sin)
    Blinn-Phong   mu Lambda = exp(-x^2) (c - mu R(x)/2),  x^2 = -(n+2)/2 ln(1 - mu^2)

Beckmann's falls from alpha sin/(2 sqrt(pi)) like a Gaussian, and its eighth root so slowly that a
polynomial has all of it. Blinn-Phong's is Heitz 2014, "Understanding the masking-shadowing
function", eq. 72, integrated over the slopes of Blinn's distribution: R is exp(x^2) times the
regularised incomplete beta function I_(1 - mu^2)((n+2)/2, 1/2). In x it is as smooth as
exp(x^2) erfc(x), for every n, and a short Chebyshev series has all its digits.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._chebyshev import Eight, eight_terms, fitted
from montecarlo_brdf.special import exp, log1p
from montecarlo_brdf.vectors import Vec

REACH = 6.4  # of Blinn-Phong: exp(-REACH^2) = 2e-18, nothing is masked beyond
BELOW_1 = 1.0 - 2.0**-52  # keeps the logarithm at the normal finite


def beckmann_hidden(w: Vec, alpha: float) -> float:
    """mu Lambda of Beckmann's distribution, Walter et al. 2007, eq. 26 without its fit.

    Error below 1.5e-15 of mu (1 + Lambda), which is what masking divides by; where nothing is
    masked, x > 6, s stays what it is at 6. Coefficients: scripts/polynomials.py.
    """
    side = alpha * math.sqrt(w[0] * w[0] + w[1] * w[1])
    s = min(w[2] / (w[2] + 16.0 * side), 6.0 / 22.0)
    s2 = s * s
    s4 = s2 * s2
    s8 = s4 * s4
    a = 1.0 - 3.544907701811091 * s
    b = -15.527204851995117 - 13.016096384332904 * s
    c = 276.09463748485143 + 1191.721067972647 * s
    d = -1647.439085952914 - 20564.47263045574 * s
    e = -6113.632344198263 + 170320.1577079254 * s
    f = -54772.154848723985 - 1594294.5119713848 * s
    g = 26468641.857386835 - 155152604.65800366 * s
    h = 441192101.7855338 - 829269721.9951361 * s
    i = 1264133885.9341154 - 1084221506.9736898 * s
    low = (a + b * s2) + (c + d * s2) * s4
    high = (e + f * s2) + (g + h * s2) * s4
    root = low + (high + i * s8) * s8
    root2 = root * root
    root4 = root2 * root2
    return 0.5 / math.sqrt(math.pi) * side * (root4 * root4)


class Series(NamedTuple):
    """What Blinn-Phong's Lambda needs to know about the exponent n."""

    n: float
    c: float
    end: float  # the cosine beyond which nothing is masked
    scale: float
    low: Eight  # coefficients of R
    middle: Eight
    high: Eight


def blinn_phong_hidden(w: Vec, p: Series) -> float:
    """mu Lambda of Blinn's distribution."""
    mu = min(w[2], p.end)
    t = (mu * (p.end + 2.0 * p.scale) - p.scale * p.end) / ((mu + p.scale) * p.end)
    b, c = eight_terms(p.high, t, 0.0, 0.0)
    b, c = eight_terms(p.middle, t, b, c)
    b, c = eight_terms(p.low, t, b, c)
    x2 = -(0.5 * p.n + 1.0) * log1p(-w[2] * w[2] * BELOW_1)
    return exp(-x2) * (p.c - 0.5 * w[2] * (b - t * c))


def blinn_phong_series(n: float) -> Series:
    """Fit R in a variable that is finer near the horizon: mu/(mu + scale)."""
    import numpy as np

    a = 0.5 * n + 1.0
    ratio = half_step(a) / math.sqrt(math.pi)
    end = math.sqrt(-math.expm1(-REACH * REACH / a))
    scale = 2.0 / math.sqrt(a + 3.0)
    node, weight = np.polynomial.legendre.leggauss(64)
    y = 0.5 * REACH * (1.0 + node)

    def scaled_tail(t: float) -> float:
        mu = scale * end * (1.0 + t) / (2.0 * scale + end - end * t)
        x = math.sqrt(-a * math.log1p(-mu * mu))
        w2 = (x + y) ** 2 / a
        integrand = np.exp(-(2.0 * x + y) * y) * np.sqrt(w2 / -np.expm1(-w2))
        return float(REACH * ratio / math.sqrt(a) * np.sum(weight * integrand))

    return Series(n, ratio / (n + 1.0), end, scale, *fitted(np.vectorize(scaled_tail), 24))


def half_step(z: float) -> float:
    """Gamma(z + 1/2)/Gamma(z), by its asymptotic series where Gamma would overflow or cancel."""
    if z < 100.0:
        return math.gamma(z + 0.5) / math.gamma(z)
    i = 1.0 / z
    tail = -399.0 / 262144.0 + i * 869.0 / 4194304.0
    tail = 5.0 / 1024.0 + i * (-21.0 / 32768.0 + i * tail)
    return math.sqrt(z) * (1.0 + i * (-1.0 / 8.0 + i * (1.0 / 128.0 + i * tail)))
