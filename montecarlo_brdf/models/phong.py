"""Phong, modified: a reciprocal cosine lobe around the mirror direction, normalised.

f = ks (n+2)/(2 pi) max(0, r.v)^n  [1/sr]

Sampling: cosine power around the mirror direction; below the horizon is rejected.
ks: albedo at the normal, 0 to 1.  n: exponent, 0 to 1e7, need not be whole.
Source: Lafortune & Willems 1994, "Using the modified Phong reflectance model for physically based
rendering", eq. 1; Phong 1975 for the lobe.
Conserves energy for ks <= 1: the albedo falls from ks at the normal towards grazing.
"""
from __future__ import annotations

import math
from typing import NamedTuple, Protocol

from montecarlo_brdf.special import cosine_power, expm1, log1p, turn
from montecarlo_brdf.vectors import Vec, mirrored, tangent_frame


class Shine(Protocol):
    """Parameters among which are those of Phong's lobe."""

    @property
    def ks(self) -> float: ...

    @property
    def n(self) -> float: ...


class Params(NamedTuple):
    ks: float = 1.0
    n: float = 32.0


domain = {"ks": (0.0, 1.0), "n": (0.0, 1e7)}
verified = [Params(), Params(n=0.0), Params(n=2.5), Params(n=1e4)]
scales_with = "ks"
lobe = ("mirror", lambda p: width(p.n))


def width(n: float) -> float:
    """The GGX width that a cosine power of exponent n looks like."""
    return math.sqrt(2.0 / (n + 2.0))


def away_from_mirror(wo: Vec, wi: Vec) -> float:
    """1 - r.v = |r - v|^2/2 of the mirror direction: no digits lost in the middle of the lobe."""
    x, y, z = wi[0] + wo[0], wi[1] + wo[1], wi[2] - wo[2]
    return 0.5 * (x * x + y * y + z * z)


def mirror_power(wo: Vec, wi: Vec, n: float) -> float:
    """max(0, r.v)^n, which for n = 0 is 1 on the half of the sphere around r."""
    return cosine_power(away_from_mirror(wo, wi), n)


def f(wo: Vec, wi: Vec, p: Shine) -> float:
    """ks (n+2)/(2 pi) (r.v)^n."""
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * mirror_power(wo, wi, p.n)


def sample(wo: Vec, u: Vec, p: Shine) -> Vec:
    """cos = (1 - u)^(1/(n+1)) from the mirror direction; may fall below the horizon.

    cos stays above 1e-15, where the rounded direction still has r.v > 0 and so a density (n = 0).
    """
    d = min(-expm1(log1p(-u[0]) / (p.n + 1.0)), 1.0 - 1e-15)
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


def pdf(wo: Vec, wi: Vec, p: Shine) -> float:
    """(n+1)/(2 pi) (r.v)^n."""
    return (p.n + 1.0) / (2.0 * math.pi) * mirror_power(wo, wi, p.n)
