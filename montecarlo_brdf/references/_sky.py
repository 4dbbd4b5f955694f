"""Reflected radiance of any f under any sky, both given as functions, by adaptive quadrature.

The integral is taken in a chart (x, y) of the directions that matter: the hemisphere around the
normal, or a cap around an axis (the sky's, or the mirror direction of a Phong lobe) cut by the
horizon; edges of the first cells lie where f has kinks and where its lobe stands. Each cell is
integrated by two Gauss rules whose difference bounds its error; cells are quartered until the sum
of the errors is small. Lobes of half vectors under smooth skies use the slopes of `_quadrature`.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.references._quadrature import NORMAL_VIEW, Geometry, slope_albedo
from montecarlo_brdf.references._rules import ROUNDING, Array, gauss

Integrand = Callable[[Array], Array]  # directions (n, 3) -> f L
Chart = Callable[[Array, Array], tuple[Array, Array]]  # (x, y) -> directions, solid angle per dx dy
Vector = Sequence[float]

FINE, COARSE = 12, 8
ENOUGH = 1e-12
MOST_CELLS = 6000
BATCH = 400


class Region(NamedTuple):
    """A chart with the first edges of its cells."""

    chart: Chart
    x: list[float]
    y: list[float]


def hemisphere(wo: Vector, _width: float) -> Region:
    """theta and azimuth from the view's plane; kinks at theta_o and across the plane."""
    theta_o, phi_o = math.atan2(math.hypot(wo[0], wo[1]), wo[2]), math.atan2(wo[1], wo[0])

    def chart(x: Array, y: Array) -> tuple[Array, Array]:
        z = np.sin(0.5 * np.pi - x)
        s = np.sin(x)
        return np.stack([s * np.cos(phi_o + y), s * np.sin(phi_o + y), z], axis=1), s

    thetas = _within(0.0, 0.5 * math.pi, [theta_o, 0.8, 1.4, 1.55])
    return Region(chart, thetas, [-math.pi, -0.5 * math.pi, 0.0, 0.5 * math.pi, math.pi])


def around(axis: Vector, reach: float, peak: Vector, width: float) -> Region:
    """Angle from an axis up to `reach`, and azimuth about it within the horizon.

    y in [-1, 1] spans the azimuths above the horizon, y = 0 being the one towards the normal.
    """
    tilt = math.atan2(math.hypot(axis[0], axis[1]), axis[2])
    up = np.array([0.0, 0.0, 1.0])
    u = np.array(axis)
    e1 = up - u[2] * u if math.sin(tilt) > 1e-12 else np.array([1.0, 0.0, 0.0])
    e1 = e1 / np.linalg.norm(e1)
    e2 = np.cross(u, e1)

    def half_range(x: Array) -> Array:
        """Azimuths |a| < this are above the horizon: cos x cos tilt + sin x sin tilt cos a > 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            c = -np.cos(x) * math.cos(tilt) / (np.sin(x) * math.sin(tilt))
        c = np.where(np.isnan(c), -1.0, c)
        return np.arccos(np.clip(c, -1.0, 1.0))

    def chart(x: Array, y: Array) -> tuple[Array, Array]:
        half = half_range(x)
        a, s = y * half, np.sin(x)
        side = (s * np.cos(a))[:, None] * e1 + (s * np.sin(a))[:, None] * e2
        return np.cos(x)[:, None] * u + side, s * half

    low, high = max(0.0, tilt - 0.5 * math.pi), min(reach, 0.5 * math.pi + tilt, math.pi)
    at = math.atan2(float(np.linalg.norm(np.cross(peak, u))), float(np.dot(peak, u)))
    turned = math.atan2(float(np.dot(peak, e2)), float(np.dot(peak, e1)))
    near = [at + k * width for k in (-32, -8, -2, 0, 2, 8, 32)]
    bends = [abs(0.5 * math.pi - tilt), 1.5 * math.pi - tilt, 0.5 * math.pi]
    ends = float(half_range(np.array([max(at, 1e-9)]))[0]) or 1.0
    spread = width / max(math.sin(at), width)
    beside = [(turned + k * spread) / ends for k in (-32, -8, -2, 0, 2, 8, 32)]
    return Region(chart, _within(low, high, [*near, *bends]), _within(-1.0, 1.0, [0.0, *beside]))


def _within(low: float, high: float, edges: list[float]) -> list[float]:
    inside = sorted(e for e in edges if low + 1e-9 < e < high - 1e-9)
    kept = [e for k, e in enumerate(inside) if k == 0 or e - inside[k - 1] > 1e-9]
    return [low, *kept, high]


def adaptive(g: Integrand, region: Region) -> tuple[float, float]:
    """The integral of g over the solid angle of a region, and a bound on its error."""
    if region.x[-1] <= region.x[0]:
        return 0.0, 0.0
    x, y = np.array(region.x), np.array(region.y)
    low = np.stack(np.meshgrid(x[:-1], y[:-1], indexing="ij"), axis=-1).reshape(-1, 2)
    high = np.stack(np.meshgrid(x[1:], y[1:], indexing="ij"), axis=-1).reshape(-1, 2)
    cells = np.concatenate([low, high], axis=1)
    parts = _measured(g, region.chart, cells)
    while len(cells) < MOST_CELLS:
        error, magnitude = parts[:, 1].sum(), parts[:, 2].sum()
        if not error > ENOUGH * magnitude:
            break
        worst = np.argsort(parts[:, 1])[-BATCH:]
        worst = worst[parts[worst, 1] > 0.1 * ENOUGH * magnitude / len(cells)]
        new = _quartered(cells[worst])
        cells = np.concatenate([np.delete(cells, worst, axis=0), new])
        parts = np.concatenate([np.delete(parts, worst, axis=0), _measured(g, region.chart, new)])
    value, error, magnitude = (float(v) for v in parts.sum(axis=0))
    return value, error + ROUNDING * magnitude


def _measured(g: Integrand, chart: Chart, cells: Array) -> Array:
    """Columns value, error and magnitude of every cell."""
    fine, magnitude = _sums(g, chart, cells, FINE)
    coarse, _ = _sums(g, chart, cells, COARSE)
    return np.stack([fine, np.abs(fine - coarse), magnitude], axis=1)


def _sums(g: Integrand, chart: Chart, cells: Array, n: int) -> tuple[Array, Array]:
    rule = gauss(n)
    size = cells[:, 2:] - cells[:, :2]
    x = cells[:, 0:1] + size[:, 0:1] * rule.x
    y = cells[:, 1:2] + size[:, 1:2] * rule.x
    x, y = np.broadcast_arrays(x[:, :, None], y[:, None, :])
    weight = (rule.weight[:, None] * rule.weight) * (size[:, 0] * size[:, 1])[:, None, None]
    directions, density = chart(x.ravel(), y.ravel())
    terms = g(directions) * np.maximum(directions[:, 2], 0.0) * density * weight.ravel()
    terms = terms.reshape(len(cells), -1)
    return terms.sum(axis=1), np.abs(terms).sum(axis=1)


def _quartered(cells: Array) -> Array:
    middle = 0.5 * (cells[:, :2] + cells[:, 2:])
    quarters = [
        [cells[:, 0], cells[:, 1], middle[:, 0], middle[:, 1]],
        [middle[:, 0], cells[:, 1], cells[:, 2], middle[:, 1]],
        [cells[:, 0], middle[:, 1], middle[:, 0], cells[:, 3]],
        [middle[:, 0], middle[:, 1], cells[:, 2], cells[:, 3]],
    ]
    return np.concatenate([np.stack(q, axis=1) for q in quarters])


def half_vector(g: Integrand, wo: Vector, width: float) -> tuple[float, float]:
    """The same for a lobe of half vectors under a smooth sky, in slopes fitted to the horizon."""
    tan_o = max(math.hypot(wo[0], wo[1]) / wo[2], NORMAL_VIEW)
    phi_o = math.atan2(wo[1], wo[0])
    sin_o = tan_o / math.hypot(1.0, tan_o)  # of the chart's view, which is never quite the normal

    def both_sides(q: Geometry) -> Array:
        """g is averaged over wi and its mirror image in the view's plane."""
        k, t, h_n = np.broadcast_arrays(q.k, q.t, q.h_n)
        c = np.clip(k / tan_o, -1.0, 1.0)
        s = np.sqrt((1.0 - c) * (1.0 + c))
        twice = 2.0 * q.h_v * h_n * t
        x, y = twice * c - sin_o, twice * s
        z = np.broadcast_to(q.mu_i, x.shape)
        return 0.5 * (_turned(g, x, y, z, phi_o) + _turned(g, x, -y, z, phi_o))

    return slope_albedo(both_sides, wo[2], width=width)


def _turned(g: Integrand, x: Array, y: Array, z: Array, phi: float) -> Array:
    c, s = math.cos(phi), math.sin(phi)
    wi = np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
    return g(wi.reshape(-1, 3)).reshape(x.shape)


def texels(g: Integrand, values: Array) -> tuple[float, float]:
    """Under a latitude-longitude image of constant texels, zenith first, azimuth from -pi.

    Each texel above the horizon is integrated by Gauss rules of 4 and 3 nodes a side.
    """
    height, width = values.shape
    cells = [
        (math.pi * r / height, min(math.pi * (r + 1) / height, 0.5 * math.pi), r, c)
        for r in range((height + 1) // 2)
        for c in np.flatnonzero(values[r])
    ]
    if not cells:
        return 0.0, 0.0
    table = np.array(cells)
    row, column = table[:, 2].astype(int), table[:, 3].astype(int)
    turn = 2.0 * np.pi / width
    low = -np.pi + column * turn
    boxes = np.stack([table[:, 0], low, table[:, 1], low + turn], axis=1)

    def chart(x: Array, y: Array) -> tuple[Array, Array]:
        s = np.sin(x)
        return np.stack([s * np.cos(y), s * np.sin(y), np.cos(x)], axis=1), s

    fine, coarse = (_sums(g, chart, boxes, n)[0] * values[row, column] for n in (4, 3))
    magnitude = float(np.abs(fine).sum())
    return float(fine.sum()), float(np.abs(fine - coarse).sum()) + ROUNDING * magnitude
