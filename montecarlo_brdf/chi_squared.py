"""The chi-squared distributions, central and not, without the import of scipy.special, which takes
as long as all kernels of a small model.

Sources: DLMF 8.11.4 and 8.9.2 (incomplete gamma), 8.8.5 (its recurrence); the noncentral one is a
Poisson mixture of central ones.
"""

from __future__ import annotations

import math

TINY = 1e-16  # relative, of a last term
LONG = 100_000  # terms at most
REACH, MORE = 12.0, 30  # standard deviations of the Poisson weights that are summed, more terms


def upper_tail(x: float, dof: int) -> float:
    """P(chi2 > x); relative error about 1e-12 however small the tail."""
    a, y = 0.5 * dof, 0.5 * x
    if y <= 0.0 or y == math.inf:
        return 1.0 if y <= 0.0 else 0.0
    return 1.0 - _series(a, y) if y < a + 1.0 else _fraction(a, y)


def _term(b: float, y: float) -> float:
    """y^b e^-y/Gamma(b + 1), the probability of b for a Poisson variable of mean y."""
    return math.exp(b * math.log(y) - y - math.lgamma(b + 1.0))


def _series(a: float, y: float) -> float:
    """P(a, y) for y not much above a."""
    term = total = _term(a, y)
    for n in range(1, LONG):
        term *= y / (a + n)
        total += term
        if term < TINY * total:
            break
    return total


def _fraction(a: float, y: float) -> float:
    """Q(a, y) for y above a + 1, by Lentz's continued fraction."""
    b = y + 1.0 - a
    c, d = math.inf, 1.0 / b
    value = d
    for n in range(1, LONG):
        factor = n * (a - n)
        b += 2.0
        d = 1.0 / (b + factor * d)
        c = b + factor / c
        value *= c * d
        if abs(c * d - 1.0) < TINY:
            break
    return a * _term(a, y) * value


def noncentral(x: float, dof: int, excess: float) -> tuple[float, float]:
    """P(chi2 <= x) with noncentrality `excess`, and its derivative by that.

    From the last term down all that is added is positive: nothing cancels.
    """
    a, y, mean = 0.5 * dof, 0.5 * x, 0.5 * excess
    # the largest product of a weight and a probability, which falls once a + j exceeds y
    middle = min(mean, 0.5 * (math.sqrt(a * a + 4.0 * mean * y) - a))
    width = REACH * math.sqrt(middle) + MORE
    first, last = max(0, int(middle - width)), int(middle + width)
    weight, term = _term(last, mean), _term(a + last, y)
    below = _series(a + last, y)
    total = change = 0.0
    for j in range(last, first - 1, -1):
        total += weight * below
        change -= weight * term
        weight *= j / mean
        term *= (a + j) / y
        below += term
    return total, 0.5 * change


def largest_excess(x: float, dof: int, level: float) -> float:
    """The noncentrality under which chi2 <= x has probability `level`, x >= dof, level < 0.4.

    Newton's steps on the logarithm, which is concave: they come from above and never pass.
    """
    # sqrt(chi2) spreads by at most 1 about sqrt(dof + excess)
    excess = (math.sqrt(x) + math.sqrt(-2.0 * math.log(level))) ** 2 - dof
    for _ in range(200):
        value, change = noncentral(x, dof, excess)
        step = value / change * math.log(value / level)
        excess = excess - step if excess > step else 0.5 * excess
        if abs(step) < 1e-13 * excess:
            break
    return excess
