"""Integrands by slopes of half vectors, for models without a sampler and densities with steps.

They see a lobe of any width from FINEST on, at the mirror direction or at the given one itself.
"""
from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf.sampling.warps import random_hemisphere, random_hemisphere_cosine

F: Any = None
PDF: Any = None
SKY: Any = None

FINEST = 1e-3  # slope of the half vector from which on a lobe is resolved


def albedo_slopes(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwi for models without a sampler: cosine-weighted where fixed[3] is 0, else by slopes
    of the half vector with wo (fixed[3] = 1: a lobe at the mirror direction) or with its mirror
    image (-1: a lobe at wo itself)."""
    wo = (fixed[0], fixed[1], fixed[2])
    if fixed[3] == 0.0:
        return F(wo, random_hemisphere_cosine(u[0], u[1]), p) * math.pi
    wi, area = slopes((fixed[3] * wo[0], fixed[3] * wo[1], wo[2]), u[0], u[1])
    return F(wo, wi, p) * wi[2] * area


def reverse_slopes(u: Any, fixed: Any, p: Any) -> float:
    """The same for R(wi)."""
    wi = (fixed[0], fixed[1], fixed[2])
    if fixed[3] == 0.0:
        return F(random_hemisphere_cosine(u[0], u[1]), wi, p) * math.pi
    wo, area = slopes((fixed[3] * wi[0], fixed[3] * wi[1], wi[2]), u[0], u[1])
    return F(wo, wi, p) * wo[2] * area


def radiance_slopes(u: Any, fixed: Any, p: Any) -> float:
    """f L cos dwi in the same way; |fixed[3]| - 1 says which sky."""
    wo = (fixed[0], fixed[1], fixed[2])
    side = 1.0 if fixed[3] > 0.0 else -1.0
    wi, area = slopes((side * wo[0], side * wo[1], wo[2]), u[0], u[1])
    return F(wo, wi, p) * wi[2] * SKY(wi, abs(fixed[3]) - 1.0) * area


def density_slopes(u: Any, fixed: Any, p: Any) -> float:
    """pdf dwi in the same way."""
    wo = (fixed[0], fixed[1], fixed[2])
    wi, area = slopes((fixed[3] * wo[0], fixed[3] * wo[1], wo[2]), u[0], u[1])
    return PDF(wo, wi, p) * area


def density_uniform(u: Any, fixed: Any, p: Any) -> float:
    """pdf dwi by uniform directions."""
    wi = random_hemisphere(u[0], u[1])
    return PDF((fixed[0], fixed[1], fixed[2]), wi, p) * 2.0 * math.pi


def slopes(v: Any, x: float, b: float) -> Any:
    """(w, dw/dx db): half vectors whose slopes are even in their logarithm up to the horizon, as
    estimate.quadrature has them, from FINEST on."""
    side = math.sqrt(v[0] * v[0] + v[1] * v[1])
    ex, ey = (v[0] / side, v[1] / side) if side > 0.0 else (1.0, 0.0)
    c, s = math.cos(2.0 * math.pi * b), math.sin(2.0 * math.pi * b)
    k = side / v[2] * c
    root = abs(k) + math.sqrt(k * k + 1.0)
    last = root if k >= 0.0 else 1.0 / root
    span = math.log1p((last / FINEST) * (last / FINEST))
    grown = math.expm1(x * span)
    t2 = FINEST * FINEST * grown
    t = math.sqrt(t2)
    z = 1.0 / math.sqrt(1.0 + t2)
    dot = z * (v[2] + side * c * t)
    along, across = 2.0 * dot * z * t * c - side, 2.0 * dot * z * t * s
    area = 4.0 * math.pi * dot * z * z * z * FINEST * FINEST * (grown + 1.0) * span
    w = (ex * along - ey * across, ey * along + ex * across, max(2.0 * dot * z - v[2], 1e-12))
    return w, area
