"""Directions: length, moments, joint distribution and the ends of [0, 1)."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import compiled_points as bulk
import numpy as np
import pytest
from scipy import stats

from montecarlo_brdf.sampling import warps

COUNT = 1 << 20
EDGES = [0.0, 5e-324, 1e-310, 1e-300, 2.0**-53, 0.25, 0.5 - 2.0**-54, 0.5, 0.75, 1.0 - 2.0**-53]
ENDS = np.array([(a, b) for a in EDGES for b in EDGES])
U = bulk.points("independent", 2024, 0, COUNT)
UNIT_VECTORS = [
    warps.random_sphere,
    warps.random_hemisphere,
    warps.random_hemisphere_cosine,
]
#: polynomials for sine and cosine err by 3 units of 2^-53 and enter four times
NORM = 16 * 2.0**-53
#: standard errors; about 50 comparisons at 4e-8 each
SIGMAS = 5.5


@pytest.mark.parametrize("function", UNIT_VECTORS)
def test_unit_length_to_the_last_digits(function: Callable[..., Any]) -> None:
    u = np.concatenate([U[: 1 << 17, :2], ENDS])
    w = bulk.warped(function, u[:, 0].copy(), u[:, 1].copy())
    assert np.abs((w**2).sum(axis=1) - 1.0).max() < NORM
    in_python = np.array([function(*pair) for pair in np.concatenate([u[:500], ENDS]).tolist()])
    assert np.abs((in_python**2).sum(axis=1) - 1.0).max() < NORM


@pytest.mark.parametrize("function", [*UNIT_VECTORS, warps.random_disk])
def test_ends_of_the_interval(function: Callable[..., Any]) -> None:
    w = bulk.warped(function, ENDS[:, 0].copy(), ENDS[:, 1].copy())
    assert np.isfinite(w).all() and np.abs(w).max() <= 1.0 + NORM
    if function is not warps.random_sphere and w.shape[1] == 3:
        assert w[:, 2].min() >= 0.0
    if function is warps.random_hemisphere_cosine:
        assert w[:, 2].min() > 0.0


def means(w: Any) -> dict[str, Any]:
    x, y, z = w.T
    return {"x": x, "y": y, "z": z, "xx": x * x, "yy": y * y, "zz": z * z, "xy": x * y, "yz": y * z,
            "xxyy": x * x * y * y}  # fmt: skip


UNIFORM = {"x": 0, "y": 0, "z": 1 / 2, "xx": 1 / 3, "yy": 1 / 3, "zz": 1 / 3, "xy": 0, "yz": 0,
           "xxyy": 1 / 15}  # fmt: skip
COSINE = {"x": 0, "y": 0, "z": 2 / 3, "xx": 1 / 4, "yy": 1 / 4, "zz": 1 / 2, "xy": 0, "yz": 0,
          "xxyy": 1 / 24}  # fmt: skip
MOMENTS = [
    (warps.random_sphere, {**UNIFORM, "z": 0}),
    (warps.random_hemisphere, UNIFORM),
    (warps.random_hemisphere_cosine, COSINE),
]


@pytest.mark.parametrize(("function", "expected"), MOMENTS)
def test_moments(function: Callable[..., Any], expected: dict[str, float]) -> None:
    for name, value in means(bulk.warped(function, U[:, 0], U[:, 1])).items():
        error = value.std() / math.sqrt(COUNT)
        assert abs(value.mean() - expected[name]) < SIGMAS * error, name


def equal_cells(w: Any) -> dict[str, Any]:
    """For each density, a coordinate that is uniform on [0, 1) if the directions follow it."""
    radius = w[:, 0] ** 2 + w[:, 1] ** 2
    z = w[:, 2] if w.shape[1] == 3 else 0.0 * radius
    return {"sphere": 0.5 + 0.5 * z, "uniform": z, "cosine": z * z, "disk": radius}


def joint_p_value(w: Any, density: str) -> float:
    """chi^2 of the polar coordinate and the azimuth in 32 x 32 cells of equal probability."""
    polar = equal_cells(w)[density]
    azimuth = np.arctan2(w[:, 1], w[:, 0]) / (2 * math.pi) + 0.5
    rows, columns = (np.clip(32 * v, 0, 31).astype(int) for v in (polar, azimuth))
    return float(stats.chisquare(np.bincount(32 * rows + columns, minlength=1024)).pvalue)


JOINT = [
    (warps.random_sphere, "sphere"),
    (warps.random_hemisphere, "uniform"),
    (warps.random_hemisphere_cosine, "cosine"),
    (warps.random_disk, "disk"),
]


@pytest.mark.parametrize(("function", "density"), JOINT)
def test_joint_distribution(function: Callable[..., Any], density: str) -> None:
    """Five tests at 1e-7 each."""
    assert joint_p_value(bulk.warped(function, U[:, 0], U[:, 1]), density) > 1e-7


@pytest.mark.parametrize(("function", "density"), JOINT)
def test_joint_test_sees_what_marginals_hide(function: Callable[..., Any], density: str) -> None:
    """A polar angle tied to the azimuth has both marginals right."""
    tied = bulk.warped(function, U[:, 0], (U[:, 0] + 0.1 * U[:, 1]) % 1.0)
    assert joint_p_value(tied, density) < 1e-100
    wrong = "uniform" if density == "cosine" else "cosine"
    if density != "disk":
        assert joint_p_value(bulk.warped(function, U[:, 0], U[:, 1]), wrong) < 1e-100


def test_density() -> None:
    """Exact values, nothing below the horizon, and integral 1 (midpoint rule, error 1e-9)."""
    z, pdf = (np.arange(20_000) + 0.5) / 20_000, warps.pdf_hemisphere_cosine
    total = 2 * math.pi * np.mean([pdf((0.0, math.sqrt(1 - v * v), v)) for v in z.tolist()])
    assert abs(total - 1.0) < 1e-9
    assert pdf((1.0, 0.0, 0.0)) == pdf((0.6, 0.0, -0.8)) == 0.0
