"""Modified Phong without the clamp: f = ks (n+2)/(2 pi) (r.v)^n of whole n, by its parity.

With J(pi - theta) = J(theta) - 2 pi cos(theta)/(n+2) for the double-axis moment of `_phong`, the
half of the lobe below the mirror direction's equator takes from the clamped albedo (odd), or adds
to it (even), J(pi - theta):

    odd    A = ks cos(theta),    even   A = ks (2 (n+2)/(2 pi) J_n - cos(theta))

2 (n+2)/(2 pi) J_n - mu = mu I_{mu^2}(1/2, n/2+1) + B_n/pi s^(n+2), in positive terms.
"""

import math

from montecarlo_brdf.references._phong import b_n, mirrored_double_axis
from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, ks: float, n: float, parity: str = "odd") -> Truth:
    if parity == "odd":
        return closed_form(ks * cos_theta_o, "A = ks mu_o: odd moments of opposite axes")
    return closed_form(ks * mirrored_double_axis(cos_theta_o, n), "A = ks ((n+2)/pi J_n - mu_o)")


def bihemispherical(*, ks: float, n: float, parity: str = "odd") -> Truth:
    more = 0.0 if parity == "odd" else b_n(n) / (math.pi * (n + 2.0))
    return closed_form(2.0 / 3.0 * ks * (1.0 + more), "2 int A mu dmu")
