"""The one integral that the Oren-Nayar family shares.

All its members are a constant plus a multiple of si so max(0, cos dphi)/max(mu_i, mu_o), whose
cosine-weighted integral over the hemisphere is

    G(theta) = s (theta - s mu) + (2/3)(s/mu)(1 - s^3),    0 at the normal, pi/2 at grazing.

Near grazing (1 - s^3)/mu is a quotient of small numbers; mu (1 + s + s^2)/(1 + s) is the same.
Fujii's members divide by 1 instead of max(mu_i, mu_o) where cos dphi < 0: G - (2/3) s.
"""

import math

from montecarlo_brdf.references._truth import sine

MEAN_G = 2.0 / 3.0 - 64.0 / (45.0 * math.pi)  # (1/pi) times the bihemispherical mean of G
MEAN_G_FUJII = 2.0 / 3.0 - 28.0 / (15.0 * math.pi)


def g_qualitative(mu: float) -> float:
    s = sine(mu)
    cap = mu * (1.0 + s + s * s) / (1.0 + s)
    return s * (math.atan2(s, mu) - s * mu) + 2.0 / 3.0 * s * cap


def g_fujii(mu: float) -> float:
    return g_qualitative(mu) - 2.0 / 3.0 * sine(mu)


def constants(sigma: float) -> tuple[float, float]:
    """A1 and B of Oren & Nayar 1994; sigma is the standard deviation of the slope angle, rad."""
    variance = sigma * sigma
    return 1.0 - variance / (2.0 * (variance + 0.33)), 0.45 * variance / (variance + 0.09)
