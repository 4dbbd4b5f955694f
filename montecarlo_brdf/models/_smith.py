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

from montecarlo_brdf.special import exp, log1p
from montecarlo_brdf.vectors import Vec

REACH = 6.4  # exp(-REACH^2) = 2e-18: nothing is masked beyond
TERMS = 22
BELOW_1 = 1.0 - 2.0**-52  # keeps the logarithm at the normal finite


def erfcx(x: float) -> float:
    """exp(x^2) erfc(x) for 0 <= x <= 7, absolute error below 6e-16; scripts/polynomials.py."""
    s = (x - 2.0) / (x + 2.0)
    p = -2.0441805193191522e-08 * s - 1.4982964749038872e-07
    p = (p * s - 4.2355434640269846e-07) * s - 3.420983643713441e-07
    p = (p * s + 1.1864392016306279e-06) * s + 3.709350449486459e-06
    p = (p * s + 1.3799681469860685e-06) * s - 1.3952258599636823e-05
    p = (p * s - 2.757420451369385e-05) * s + 2.7524174928679665e-05
    p = (p * s + 0.0001743600204039873) * s + 4.3555562393116e-05
    p = (p * s - 0.0009819769088012897) * s - 0.0008471432356558474
    p = (p * s + 0.006997461733132937) * s + 0.003732892403369275
    p = (p * s - 0.07897858101559538) * s + 0.24165819424248539
    return (p * s - 0.4271858474139593) * s + 0.2553956763105057


def beckmann_hidden(w: Vec, alpha: float) -> float:
    """mu Lambda of Beckmann's distribution, Walter et al. 2007, eq. 26 without its fit."""
    side = alpha * math.sqrt(w[0] * w[0] + w[1] * w[1])
    x = w[2] / (side + 1e-150)
    rest = side / math.sqrt(math.pi) - w[2] * erfcx(min(x, REACH))
    return 0.5 * exp(-x * x) * rest


def blinn_phong_hidden(w: Vec, n: float, series: tuple[float, ...]) -> float:
    """mu Lambda of Blinn's distribution; `series` is `blinn_phong_series(n)`."""
    mu = min(w[2], series[1])
    x2 = -(0.5 * n + 1.0) * log1p(-w[2] * w[2] * BELOW_1)
    return exp(-x2) * (series[0] - 0.5 * w[2] * chebyshev(series, 3, mapped(mu, series)))


def mapped(mu: float, series: tuple[float, ...]) -> float:
    """[0, end] onto [-1, 1], finer near 0 by c/(mu + c)."""
    end, c = series[1], series[2]
    return (mu * (end + 2.0 * c) - c * end) / ((mu + c) * end)


def chebyshev(series: tuple[float, ...], first: int, t: float) -> float:
    """Sum of series[first + k] T_k(t), by Clenshaw's recurrence."""
    b, c = 0.0, 0.0
    for k in range(len(series) - 1, first, -1):
        b, c = series[k] + 2.0 * t * b - c, b
    return series[first] + t * b - c


def blinn_phong_series(n: float) -> tuple[float, ...]:
    """(c, end, scale of `mapped`, Chebyshev coefficients of R) for exponent n."""
    import numpy as np

    a = 0.5 * n + 1.0
    ratio = half_step(a) / math.sqrt(math.pi)
    end = math.sqrt(-math.expm1(-REACH * REACH / a))
    c = 2.0 / math.sqrt(a + 3.0)
    node, weight = np.polynomial.legendre.leggauss(64)
    y = 0.5 * REACH * (1.0 + node)

    def scaled_tail(t: float) -> float:
        mu = c * end * (1.0 + t) / (2.0 * c + end - end * t)
        x = math.sqrt(-a * math.log1p(-mu * mu))
        w2 = (x + y) ** 2 / a
        integrand = np.exp(-(2.0 * x + y) * y) * np.sqrt(w2 / -np.expm1(-w2))
        return float(REACH * ratio / math.sqrt(a) * np.sum(weight * integrand))

    fitted = np.polynomial.chebyshev.chebinterpolate(np.vectorize(scaled_tail), TERMS - 1)
    return ratio / (n + 1.0), end, c, *map(float, fitted)


def half_step(z: float) -> float:
    """Gamma(z + 1/2)/Gamma(z), by its asymptotic series where Gamma would overflow or cancel."""
    if z < 100.0:
        return math.gamma(z + 0.5) / math.gamma(z)
    i = 1.0 / z
    tail = -399.0 / 262144.0 + i * 869.0 / 4194304.0
    tail = 5.0 / 1024.0 + i * (-21.0 / 32768.0 + i * tail)
    return math.sqrt(z) * (1.0 + i * (-1.0 / 8.0 + i * (1.0 / 128.0 + i * tail)))
