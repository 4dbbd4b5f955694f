"""The cosine-power lobe around the mirror direction of wo, which the Phong family shares."""
from __future__ import annotations

import math
from typing import Protocol

from montecarlo_brdf.special import cosine_power, expm1, log1p, turn
from montecarlo_brdf.vectors import Vec, mirrored, tangent_frame


class Shine(Protocol):
    """Parameters among which are those of Phong's lobe."""

    @property
    def ks(self) -> float: ...

    @property
    def n(self) -> float: ...


def away_from_mirror(wo: Vec, wi: Vec) -> float:
    """1 - r.v = |r - v|^2/2 of the mirror direction: no digits lost in the middle of the lobe."""
    x, y, z = wi[0] + wo[0], wi[1] + wo[1], wi[2] - wo[2]
    return 0.5 * (x * x + y * y + z * z)


def mirror_power(wo: Vec, wi: Vec, n: float) -> float:
    """max(0, r.v)^n, which for n = 0 is 1 on the half of the sphere around r."""
    return cosine_power(away_from_mirror(wo, wi), n)


def sample_mirror_power(wo: Vec, u: Vec, n: float) -> Vec:
    """cos = (1 - u)^(1/(n+1)) from the mirror direction; may fall below the horizon.

    cos stays above 1e-15, where the rounded direction still has r.v > 0 and so a density (n = 0).
    """
    d = min(-expm1(log1p(-u[0]) / (n + 1.0)), 1.0 - 1e-15)
    s = math.sqrt(d * (2.0 - d))
    c1, s1 = turn(u[1])
    a, b = s * c1, s * s1
    r = mirrored(wo)
    t, q = tangent_frame(r)
    return (
        r[0] - d * r[0] + a * t[0] + b * q[0],
        r[1] - d * r[1] + a * t[1] + b * q[1],
        r[2] - d * r[2] + a * t[2] + b * q[2],
    )


def mirror_power_pdf(wo: Vec, wi: Vec, n: float) -> float:
    """(n+1)/(2 pi) (r.v)^n."""
    return (n + 1.0) / (2.0 * math.pi) * mirror_power(wo, wi, n)


def width(n: float) -> float:
    """The GGX width that a cosine power of exponent n looks like."""
    return math.sqrt(2.0 / (n + 2.0))
