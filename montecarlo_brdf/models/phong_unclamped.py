"""Phong, modified, without max(0, ...): the power of a cosine that may be negative.

f = ks (n+2)/(2 pi) (r.v)^n  [1/sr]

Sampling: cosine power around the mirror direction or, half the time, opposite to it.
ks: albedo at the normal (odd), 0 to 1.  n: exponent, 0 to 1e7.
parity: what a whole exponent does to a negative cosine: odd (the power keeps the sign) or even
(|r.v|^n). Between whole numbers n is interpolated, |r.v| being what is raised.
Source: Lafortune & Willems 1994, eq. 1, with the clamp left out, as shaders do that call pow.
Violates: positivity with odd, where light and view are on the same side of the mirror direction's
equator; with even a second lobe lies opposite to the mirror direction.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models import phong
from montecarlo_brdf.models.phong import away_from_mirror, domain, lobe, scales_with
from montecarlo_brdf.special import cosine_power
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    ks: float = 1.0
    n: float = 3.0


verified = [Params(), Params(n=1.0), Params(n=10.0)]


def odd(below: bool) -> float:
    """The power keeps the sign of r.v."""
    return -1.0 if below else 1.0


def even(below: bool) -> float:
    """|r.v|^n."""
    return 1.0


choices = {
    "parity": {
        "odd": {
            "functions": {"sign": odd},
            "disclaims": {"positivity": "an odd power of a negative cosine is negative"},
        },
        "even": {"functions": {"sign": even}},
    }
}
sign = odd


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """ks (n+2)/(2 pi) (r.v)^n."""
    away = away_from_mirror(wo, wi)
    below = away > 1.0  # then 1 + r.v from its own form: 2 - away has no digits left near r.v = -1
    power = cosine_power(away_from_mirror(wo, _opposite(wi)) if below else away, p.n)
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * power * sign(below)


def _opposite(w: Vec) -> Vec:
    return -w[0], -w[1], -w[2]


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """A direction of the lobe around the mirror direction, or its opposite."""
    w = phong.sample(wo, u, p)
    side = 1.0 if u[2] < 0.5 else -1.0
    return side * w[0], side * w[1], side * w[2]


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """Half of (n+1)/(2 pi) |r.v|^n, in either of whose lobes r.v = 0 has |r.v|^0 = 1."""
    both = phong.pdf(wo, wi, p) + phong.pdf(wo, _opposite(wi), p)
    return 0.5 * (1.0 / (2.0 * math.pi) if p.n == 0.0 and both == 0.0 else both)
