"""Smith masking beyond GGX, as mu Lambda(mu), which stays finite at the horizon.

With x^2 = a exponent of the distribution, Lambda is a Gaussian times what a scaled complementary
error function leaves of a leading term:

    Beckmann      mu Lambda = exp(-x^2)/2 (alpha sin/sqrt(pi) - mu erfcx(x)),  x = mu/(alpha sin)
    Blinn-Phong   mu Lambda = exp(-x^2) (c - mu R(x)/2),  x^2 = -(n+2)/2 ln(1 - mu^2)

Blinn-Phong's R is exp(x^2) times a regularised incomplete beta function (formulas.md, section 6);
in x it is as smooth as erfcx, for every n, and a short Chebyshev series has all its digits.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._chebyshev import Eight, eight_terms, fitted
from montecarlo_brdf.special import exp, log1p
from montecarlo_brdf.vectors import Vec

REACH = 6.4  # exp(-REACH^2) = 2e-18: nothing is masked beyond
BELOW_1 = 1.0 - 2.0**-52  # keeps the logarithm at the normal finite


def erfcx(x: float) -> float:
    """exp(x^2) erfc(x) for 0 <= x <= 7, absolute error below 6e-16; scripts/polynomials.py."""
    s = (x - 2.0) / (x + 2.0)
    s2 = s * s
    s4 = s2 * s2
    s8 = s4 * s4
    a = 0.2553956763105057 - 0.4271858474139593 * s
    b = 0.24165819424248539 - 0.07897858101559538 * s
    c = 0.003732892403369275 + 0.006997461733132937 * s
    d = -0.0008471432356558474 - 0.0009819769088012897 * s
    e = 4.3555562393116e-05 + 0.0001743600204039873 * s
    f = 2.7524174928679665e-05 - 2.757420451369385e-05 * s
    g = -1.3952258599636823e-05 + 1.3799681469860685e-06 * s
    h = 3.709350449486459e-06 + 1.1864392016306279e-06 * s
    i = -3.420983643713441e-07 - 4.2355434640269846e-07 * s
    j = -1.4982964749038872e-07 - 2.0441805193191522e-08 * s
    low = (a + b * s2) + (c + d * s2) * s4
    high = (e + f * s2) + (g + h * s2) * s4
    return low + (high + (i + j * s2) * s8) * s8


def beckmann_hidden(w: Vec, alpha: float) -> float:
    """mu Lambda of Beckmann's distribution, Walter et al. 2007, eq. 26 without its fit."""
    side = alpha * math.sqrt(w[0] * w[0] + w[1] * w[1])
    x = w[2] / (side + 1e-150)
    rest = side / math.sqrt(math.pi) - w[2] * erfcx(min(x, REACH))
    return 0.5 * exp(-x * x) * rest


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
