"""Integrands in charts fitted to a model's lobe or kinks, and probes of how large integrands get.

`fixed` is the given direction and the width of the lobe. An integrand named seen_* shows the value
that albedo_* would take at one of `PROBES` directions, chosen by u[0]: a lobe that the chart does
not fit, or that its points may miss, shows as a value far above the mean.
"""
from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf.sampling import charts
from montecarlo_brdf.sampling.charts import Row, smooth_step
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.special import exp2, turn
from montecarlo_brdf.vectors import Vec

F: Any = None
INSIDE: Any = None

#: integrands of these charts are periodic already
CHARTS = ("half_vector", "mirror", "panels")
PROBES = 65
LAST = 0.9999999999999999  # the largest number below 1


def periodised(u: Any, fixed: Any, p: Any) -> float:
    """An integrand made periodic in its first coordinate: what lattices need."""
    w, _, slope = smooth_step(u[0])
    return INSIDE((min(w, LAST), u[1], u[2], u[3], u[4]), fixed, p) * slope


def periodised_twice(u: Any, fixed: Any, p: Any) -> float:
    """The same for two directions, whose polar coordinates are u[0] and u[2]."""
    w, _, slope = smooth_step(u[0])
    v, _, steep = smooth_step(u[2])
    return INSIDE((min(w, LAST), u[1], min(v, LAST), u[3], u[4]), fixed, p) * (slope * steep)


def polar(u: Any, fixed: Any) -> Row:
    """The polar coordinates of a point in charts of lobes."""
    return *charts.polar(u[0], u[1]), 0.0, 0.0, 0.0


def half_horizon(u: Any, fixed: Any) -> Row:
    """These, and where half vectors end."""
    return charts.half_horizon(fixed[:3], u[:5])


def half_vector_direction(u: Any, fixed: Any) -> Row:
    """The direction and its solid angle."""
    return *charts.half_vector(fixed[:3], u, fixed[3]), 0.0, 0.0, 0.0, 0.0


def mirror_horizon(u: Any, fixed: Any) -> Row:
    """Polar coordinates, and where the horizon is."""
    return charts.mirror_horizon(fixed[:3], u[:5])


def mirror_direction(u: Any, fixed: Any) -> Row:
    """The direction and its solid angle."""
    return *charts.mirror(fixed[:3], u, fixed[3]), 0.0, 0.0, 0.0, 0.0


def albedo_half_vector(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwi in the half-vector chart: E = A(wo)."""
    made = half_vector_direction(half_horizon(polar(u, fixed), fixed), fixed)
    return F(fixed[:3], made[:3], p) * made[2] * made[3]


def reverse_half_vector(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwo in the half-vector chart: E = R(wi)."""
    made = half_vector_direction(half_horizon(polar(u, fixed), fixed), fixed)
    return F(made[:3], fixed[:3], p) * made[2] * made[3]


def bihemispherical_half_vector(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, wi in the half-vector chart."""
    v, _, steep = smooth_step(u[2])
    wo = random_hemisphere_cosine(min(v, LAST), u[3])
    at = charts.half_horizon(wo, charts.polar(u[0], u[1]))
    x, y, z, area = charts.half_vector(wo, at, fixed[3])
    return F(wo, (x, y, z), p) * z * area * steep


def albedo_mirror(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwi in the mirror chart: E = A(wo)."""
    made = mirror_direction(mirror_horizon(polar(u, fixed), fixed), fixed)
    return F(fixed[:3], made[:3], p) * made[2] * made[3]


def reverse_mirror(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwo in the mirror chart: E = R(wi)."""
    made = mirror_direction(mirror_horizon(polar(u, fixed), fixed), fixed)
    return F(made[:3], fixed[:3], p) * made[2] * made[3]


def bihemispherical_mirror(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, wi in the mirror chart."""
    v, _, steep = smooth_step(u[2])
    wo = random_hemisphere_cosine(min(v, LAST), u[3])
    at = charts.mirror_horizon(wo, charts.polar(u[0], u[1]))
    x, y, z, area = charts.mirror(wo, at, fixed[3])
    return F(wo, (x, y, z), p) * z * area * steep


def albedo_panels(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwi, one direction in each panel between the kinks: E = A(wo)."""
    wo = fixed[:3]
    made = charts.panels(wo, u[0], u[1])
    x, y, z, area = made[:4]
    high = (F(wo, (x, y, z), p) + F(wo, (-x, -y, z), p)) * area
    x, y, z, area = made[4:]
    return high + (F(wo, (x, y, z), p) + F(wo, (-x, -y, z), p)) * area


def reverse_panels(u: Any, fixed: Any, p: Any) -> float:
    """f cos dwo, one direction in each panel between the kinks: E = R(wi)."""
    wi = fixed[:3]
    made = charts.panels(wi, u[0], u[1])
    x, y, z, area = made[:4]
    high = (F((x, y, z), wi, p) + F((-x, -y, z), wi, p)) * area
    x, y, z, area = made[4:]
    return high + (F((x, y, z), wi, p) + F((-x, -y, z), wi, p)) * area


def bihemispherical_panels(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, wi in every panel."""
    v, _, steep = smooth_step(u[2])
    wo = random_hemisphere_cosine(min(v, LAST), u[3])
    made = charts.panels(wo, u[0], u[1])
    x, y, z, area = made[:4]
    high = (F(wo, (x, y, z), p) + F(wo, (-x, -y, z), p)) * area
    x, y, z, area = made[4:]
    return (high + (F(wo, (x, y, z), p) + F(wo, (-x, -y, z), p)) * area) * steep


def probed(wo: Vec, k: float) -> Vec:
    """Direction k of PROBES in the plane of incidence: the mirror direction, 32 that come nearer to
    it by halves from both sides, 32 at equal angles."""
    ex, ey, so = charts.azimuth_of(wo)
    half = math.floor(0.5 * (k - 1.0))
    side = 2.0 * (k - 2.0 * half) - 3.0 if k > 0.0 else 0.0
    near = k < 33.0
    away = 0.125 * exp2(-half) if near else (half - 15.5) / 66.0  # of a turn
    c, s = turn(0.5 + side * away)
    sin, cos = (so * c + wo[2] * s, wo[2] * c - so * s) if near else (s, c)
    return -sin * ex, -sin * ey, cos


def seen_half_vector(u: Any, fixed: Any, p: Any) -> float:
    """The largest value of `albedo_half_vector` at a probed direction."""
    wo = fixed[:3]
    wi = probed(wo, u[0])
    area = charts.half_vector_area(wo, wi, fixed[3]) if wi[2] > 0.0 else 0.0
    return F(wo, wi, p) * wi[2] * area if wi[2] > 0.0 else 0.0


def seen_mirror(u: Any, fixed: Any, p: Any) -> float:
    """The largest value of `albedo_mirror` at a probed direction."""
    wo = fixed[:3]
    wi = probed(wo, u[0])
    area = charts.mirror_area(wo, wi, fixed[3]) if wi[2] > 0.0 else 0.0
    return F(wo, wi, p) * wi[2] * area if wi[2] > 0.0 else 0.0


def seen_cosine(u: Any, fixed: Any, p: Any) -> float:
    """The largest value at a probed direction of `albedo_cosine` made periodic."""
    wo = fixed[:3]
    wi = probed(wo, u[0])
    return 1.875 * math.pi * F(wo, wi, p) if wi[2] > 0.0 else 0.0


def seen_panels(u: Any, fixed: Any, p: Any) -> float:
    """The largest value of `albedo_panels` at a probed direction, both steps at their steepest."""
    wo = fixed[:3]
    wi = probed(wo, u[0])
    return 1.875 * 1.875 * math.pi * F(wo, wi, p) if wi[2] > 0.0 else 0.0


HALF_VECTOR = (polar, half_horizon, half_vector_direction)
MIRROR = (polar, mirror_horizon, mirror_direction)
#: the steps from a point to the direction that alone these integrands read; panels are made faster
#: in one piece
STEPS = {
    albedo_half_vector: HALF_VECTOR,
    reverse_half_vector: HALF_VECTOR,
    albedo_mirror: MIRROR,
    reverse_mirror: MIRROR,
}
