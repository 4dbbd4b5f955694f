"""Lommel-Seeliger: single scattering in a dark half-space, the Moon to first order.

f = albedo/(2 pi (mu_i + mu_o))  [1/sr]

The same as albedo times GGX with alpha = 1, f0 = 1 and height-correlated masking.

Sampling: uniform over the hemisphere, which bounds the weight by albedo.
albedo: 0 to 1; the reflected fraction is albedo (1 - mu_o ln(1 + 1/mu_o)).
Source: Seeliger 1887; Fairbairn 2005, "Planetary photometry: the Lommel-Seeliger law".
"""
from __future__ import annotations

import math

from montecarlo_brdf.models.lambert import Params, domain
from montecarlo_brdf.special import turn
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(albedo=1.0)]
scales_with = "albedo"


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """albedo/(2 pi (mu_i + mu_o))."""
    return 0.5 / math.pi * p.albedo / (wi[2] + wo[2])


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """Uniform over the hemisphere, one to one: z = 1 - u."""
    c, s = turn(u[1])
    r = math.sqrt(u[0] * (2.0 - u[0]))
    return r * c, r * s, 1.0 - u[0]


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """1/(2 pi)."""
    return 0.5 / math.pi
