"""Samplers: unit vectors above the horizon or rejected, and densities that are what they claim.

With one lobe the density is checked point by point, pdf |dw/du1 x dw/du2| = 1; where u[2] chooses
among lobes, each must not exceed the mixture. The integral over the hemisphere sees the rest.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from cases import IDS, VARIANTS, corners, made, usual

from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.vectors import from_degrees

#: Only these choices change how a model samples.
SAMPLERS = [
    pytest.param(v, id=name)
    for v, name in zip(VARIANTS, IDS, strict=True)
    if set(v[1]) <= {"distribution"}
]
PARAMETRISED = pytest.mark.parametrize("variant", SAMPLERS)
STEP, MARGIN = 1e-5, 2.0**-10
LAST = math.nextafter(1.0, 0.0)
EDGES = (0.0, 5e-324, 2.0**-53, 0.25, 0.5, 1.0 - 2.0**-30, LAST)


@PARAMETRISED
def test_extreme_numbers_give_unit_vectors_with_a_density(variant: Any) -> None:
    model = made(variant)
    grid = np.stack(np.meshgrid(EDGES, EDGES, (0.0, LAST), indexing="ij"), axis=-1).reshape(-1, 3)
    for p in corners(model):
        point = Pointwise(model, p)
        for theta in (0.0, 1e-6, 50.0, 89.9999, math.nextafter(90.0, 0.0)):
            wo = np.array(from_degrees(theta, 30.0))
            wi, _ = point.sample(wo, grid)
            assert np.allclose(np.linalg.norm(wi, axis=1), 1.0, rtol=0.0, atol=2e-15), (p, theta)
            kept = wi[wi[:, 2] > 0.0]
            density = point.pdf(wo, kept) if len(kept) else np.ones(1)
            assert np.all(np.isfinite(density)) and np.all(density > 0.0), (p, theta)


def jacobian(point: Any, wo: Any, u: Any) -> Any:
    """|dw/du1 x dw/du2| by fourth-order differences."""

    def slope(axis: int) -> Any:
        h = STEP * np.eye(3)[axis]
        near = point.sample(wo, u + h)[0] - point.sample(wo, u - h)[0]
        far = point.sample(wo, u + 2.0 * h)[0] - point.sample(wo, u - 2.0 * h)[0]
        return (8.0 * near - far) / (12.0 * STEP)

    return np.linalg.norm(np.cross(slope(0), slope(1)), axis=1)


def chooses(point: Any, wo: Any) -> bool:
    """Whether the third number changes the direction."""
    w, _ = point.sample(wo, np.array([(0.3, 0.4, 0.0), (0.3, 0.4, LAST)]))
    return not np.array_equal(w[0], w[1])


def shares(point: Any, wo: Any, u: Any) -> Any:
    """Of each u, the fraction of third numbers that lead to the same lobe, to 1e-3."""
    numbers = np.column_stack([np.full((1000, 2), 0.3), (np.arange(1000) + 0.5) / 1000])
    to_first = np.all(point.sample(wo, numbers)[0] == point.sample(wo, (0.3, 0.3, 0.0))[0], axis=1)
    first = np.mean(to_first)
    return np.where(u[:, 2] < first, first, 1.0 - first)


@PARAMETRISED
@pytest.mark.parametrize("theta", [0.0, 40.0, 85.0])
def test_density_point_by_point(variant: Any, theta: float) -> None:
    """Tolerance 1e-5.

    Samplers go as sqrt(u) and (1-u)^(1/(n+1)) near the ends, so a difference of fourth order is off
    by 0.2 (h/u)^4 = 2e-9 at the margin; a narrow lobe at grazing has a scale in u up to (1 + z)
    times smaller for every power: 16 times more. Rounding: 2^-52/(h |dw/du|), and |dw/du| is not
    below 1e-3 of the lobe's width: 1e-6 for a width of 0.02, and narrower lobes are not asked.
    """
    model = made(variant)
    rng = np.random.default_rng(6)
    wo = np.array(from_degrees(theta, 30.0))
    u = MARGIN + (1.0 - 2.0 * MARGIN) * rng.random((2000, 3))
    width = model.lobe[1] if model.lobe else lambda p: 1.0
    for p in (p for p in usual(model) if width(p) >= 0.02):
        point = Pointwise(model, p)
        wi = point.sample(wo, u)[0]
        above = wi[:, 2] > 1e-3
        product = point.pdf(wo, wi)[above] * jacobian(point, wo, u)[above]
        if chooses(point, wo):
            assert np.all(product >= shares(point, wo, u)[above] - 1e-3), p
        else:
            assert np.max(np.abs(product - 1.0)) < 1e-5, p


@PARAMETRISED
@pytest.mark.parametrize("theta", [0.0, 50.0])
def test_density_integrates_to_what_is_not_rejected(variant: Any, theta: float) -> None:
    """A grid of N^2 cells over u: the edge of the kept region cuts at most 4 N of them, so the
    fraction kept is off by at most 2/N (twice as smooth curves cross a row at most four times)."""
    model = made(variant)
    n = 512
    p = model.Params()
    point = Pointwise(model, p)
    wo = np.array(from_degrees(theta, 30.0))
    x, w = np.polynomial.legendre.leggauss(300)
    z, phi = np.meshgrid(0.5 + 0.5 * x, 2.0 * np.pi * (np.arange(256) + 0.5) / 256, indexing="ij")
    s = np.sqrt((1.0 - z) * (1.0 + z))
    wi = np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1).reshape(-1, 3)
    density = point.pdf(wo, wi).reshape(300, 256)
    integral = float(np.sum(0.5 * w[:, None] * density) * 2.0 * np.pi / 256)
    c = (np.arange(n) + 0.5) / n
    kept = []
    for u2 in ((np.arange(10) + 0.5) / 10 if chooses(point, wo) else (0.5,)):
        grid = np.stack(np.meshgrid(c, c, (u2,), indexing="ij"), axis=-1).reshape(-1, 3)
        kept.append(np.mean(point.sample(wo, grid)[0][:, 2] > 0.0))
    assert integral == pytest.approx(np.mean(kept), abs=2.0 / n)
