"""Gamma(a + 1/2)/Gamma(a); as the difference of two lgamma it would lose ten digits at 1e6."""

import math

# Stirling's series for ln Gamma(x + 3/4) - ln Gamma(x + 1/4) has only even powers of 1/x; its
# coefficients are -2 E_2j/(4^(2j+1) 2j) with the Euler numbers E_2 = -1, E_4 = 5, ...
_EULER = (-1, 5, -61, 1385, -50521)
_STIRLING = tuple(-2 * e / (4 ** (2 * j + 1) * 2 * j) for j, e in enumerate(_EULER, start=1))


def half_step(a: float) -> float:
    """Gamma(a + 1/2)/Gamma(a) for a > 0."""
    if a < 20.25:
        return math.gamma(a + 0.5) / math.gamma(a)
    x = a - 0.25
    series = sum(c * x ** (-2 * j) for j, c in enumerate(_STIRLING, start=1))
    return math.sqrt(x) * math.exp(series)
