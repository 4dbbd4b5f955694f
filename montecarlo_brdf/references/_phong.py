"""Moments of Phong's lobe over the hemisphere (Arvo 1995; Lafortune & Willems 1994), in sums.

    double axis  J_n = integral (w.r)+^n (w.n)+ dw
    single axis  M_n = integral (w.r)+^n dw  over w.n > 0

for the axis r at angle theta from n, real n > -1. With B_n = sqrt(pi) Gamma((n+1)/2)/Gamma(n/2+1)
the identity B_n B_{n+1} = 2 pi/(n+1) turns the published differences into sums of positive terms,
so nothing cancels for any n and theta:

    (n+2)/(2 pi) J_n = mu (1 + I_{mu^2}(1/2, n/2+1))/2 + B_n/(2 pi) s^(n+2)
    (n+1)/(2 pi) M_n = (1 + I_{mu^2}(1/2, (n+1)/2))/2
"""

import math

from montecarlo_brdf.references._gamma import half_step


def b_n(n: float) -> float:
    """Integral of cos^n over (-pi/2, pi/2)."""
    return math.sqrt(math.pi) / half_step(0.5 * (n + 1.0))


def _sine_power(mu: float, n: float) -> float:
    """s^n; log1p keeps the digits of a huge n near grazing, the product those near the normal."""
    square = (1.0 - mu) * (1.0 + mu)
    if square == 0.0:
        return 0.0 if n else 1.0
    return math.exp(0.5 * n * (math.log1p(-mu * mu) if mu < 0.5 else math.log(square)))


def double_axis(mu: float, n: float) -> float:
    """(n+2)/(2 pi) J_n: 1 at the normal, B_n/(2 pi) at grazing."""
    from scipy.special import betainc

    lobe = 0.5 * mu * (1.0 + float(betainc(0.5, 0.5 * n + 1.0, mu * mu)))
    return lobe + b_n(n) / (2.0 * math.pi) * _sine_power(mu, n + 2.0)


def single_axis(mu: float, n: float) -> float:
    """(n+1)/(2 pi) M_n: 1 at the normal, 1/2 at grazing."""
    from scipy.special import betainc

    return 0.5 * (1.0 + float(betainc(0.5, 0.5 * (n + 1.0), mu * mu)))


def mirrored_double_axis(mu: float, n: float) -> float:
    """(n+2)/(2 pi) (J_n(theta) + J_n(pi - theta)): the lobe and its mirror image below."""
    from scipy.special import betainc

    lobe = mu * float(betainc(0.5, 0.5 * n + 1.0, mu * mu))
    return lobe + b_n(n) / math.pi * _sine_power(mu, n + 2.0)
