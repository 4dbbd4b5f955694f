"""The failures that others published, reproduced by the ladder, each with its number."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from columns import in_precision

from montecarlo_brdf.arithmetic import rung as ladder
from montecarlo_brdf.arithmetic import types as arithmetic
from montecarlo_brdf.stability.specimens import (
    beckmann_by_angle,
    biased_ggx,
    guarded_ggx,
    load,
    textbook_beckmann,
    textbook_eon,
    textbook_ggx,
)

SINGLE, DOUBLE, HALF = (arithmetic.precision(n) for n in ("float32", "float64", "float16"))
#: Cosines of angles from 0 to 90 degrees, dense near the normal.
COSINES = np.cos(np.r_[0.0, np.geomspace(1e-5, math.pi / 2, 40_000)])


def worst(function: Callable[..., Any], alpha: float) -> float:
    """Worst relative error of D(n.h, alpha) when n.h and all that follows is single precision."""
    a = np.full(len(COSINES), float(np.float32(alpha)))
    single = in_precision(function, SINGLE, COSINES, a)
    truth = in_precision(textbook(function), DOUBLE, COSINES, a)
    seen = truth > 1e-7 * truth.max()  # beyond that a rounding of the peak is larger
    return float(np.max(np.abs(single - truth)[seen] / truth[seen]))


def textbook(function: Callable[..., Any]) -> Callable[..., Any]:
    """What serves as truth in double: 1e-10 at alpha = 0.001, where single has lost the digits."""
    return textbook_beckmann.density if function is beckmann_by_angle.density else function


@pytest.mark.parametrize(("alpha", "published"), [(0.1, 2e-5), (0.01, 1.5e-3), (0.001, 0.12)])
def test_textbook_ggx_loses_a_rounding_of_1_over_alpha_squared(
    alpha: float, published: float
) -> None:
    # Below 1 a rounding is 2^-25. d = c^2 (a^2 - 1) + 1, near its minimum a^2, takes that of c
    # twice and those of c^2, a^2 - 1, their product and the sum: 6 * 2^-25/a^2; D has d squared.
    d = 6.0 * 2.0**-25 / alpha**2
    error = worst(textbook_ggx.density, alpha)
    assert error <= (1.0 - d) ** -2 - 1.0 + 8 * 2.0**-24  # and the relative roundings of the rest
    assert published / 1.5 <= error <= published * 1.5  # "about", on another grid of angles


def integral(density: Callable[[float, float], float], alpha: float) -> float:
    """int D cos dw = 2 pi int D(c) c dc, by the trapezoidal rule in log(tan theta)."""
    step = 0.01
    t = np.exp(np.arange(-18.0, 6.0, step))
    weights = step * 2.0 * math.pi * t**2 / (1.0 + t**2) ** 2  # c dc = t dt/(1 + t^2)^2
    c = 1.0 / np.sqrt(1.0 + t**2)
    return float(sum(k * density(float(v), alpha) for k, v in zip(weights, c, strict=False)))


@pytest.mark.parametrize(
    ("specimen", "roughness", "published", "digit"),
    [
        (guarded_ggx, 0.3, 0.70, 0.01),
        (guarded_ggx, 0.2, 0.17, 0.01),
        (guarded_ggx, 0.1, 0.011, 0.001),
        (biased_ggx, 0.1, 0.15, 0.01),
        (biased_ggx, 0.05, 0.0098, 0.0001),
    ],
)
def test_guards_remove_the_highlight(
    specimen: Any, roughness: float, published: float, digit: float
) -> None:
    alpha = roughness**2
    assert integral(textbook_ggx.density, alpha) == pytest.approx(1.0, abs=1e-4)  # tail beyond e^6
    assert abs(integral(specimen.density, alpha) - published) <= 0.5 * digit + 1e-4


@pytest.mark.parametrize("n", [1e4, 1e5, 1e6])
def test_textbook_phong_multiplies_a_rounding_by_n(n: float) -> None:
    # r.v is a sum of three rounded products near 1: between half a rounding below 1 (2^-25) and
    # three of 2^-24; published is n 2^-25: 3e-4, 3e-3, 3e-2.
    rng = np.random.default_rng(1)
    theta = rng.uniform(0.2, 1.2, 4000)
    wo = np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], axis=1)
    wi = wo * (-1.0, 1.0, 1.0) + rng.normal(0.0, 0.5 / math.sqrt(n), wo.shape)
    wo, wi = (ladder.unit(w, DOUBLE).astype(np.float32) for w in (wo, wi))
    model = load("textbook_phong")
    single = ladder.Rung(model, SINGLE).f(wo, wi, ladder.rounded(model.parameters(n=n), SINGLE))
    p = model.parameters(n=n)
    truth = ladder.Rung(model, DOUBLE).f(ladder.unit(wo, DOUBLE), ladder.unit(wi, DOUBLE), p)
    error = float(np.max(np.abs(single - truth) / truth))
    # the norms of both directions are off by up to 2^-24 too, in the worst case
    assert n * 2.0**-25 <= error <= math.expm1(n * (3 + 2) * 2.0**-24)


def test_textbook_eon_term() -> None:
    mu = np.geomspace(1e-5, 1.0, 400_000)[:-1].astype(np.float32)
    truth = in_precision(textbook_eon.term_to_ship, DOUBLE, mu)
    off = np.abs(in_precision(textbook_eon.term, SINGLE, mu) - truth)
    stable = np.abs(in_precision(textbook_eon.term_to_ship, SINGLE, mu) - truth)
    # s rounds down to 1 - 2^-24 where mu^2/2 passes 2^-25: mu = 2.4e-4 for nearest, 1.7e-4 once
    # 1 - mu^2 is rounded first; there 1 - s^3 = 3 * 2^-24 instead of 3 mu^2/2
    assert off.max() == pytest.approx(7.8e-4, rel=0.05)
    assert mu[off.argmax()] == pytest.approx(1.7e-4, rel=0.05)
    away = mu < 0.5  # near 1 both share the error of s
    assert np.max((stable / truth)[away]) < 8 * 2.0**-24  # eight roundings, s twice


def test_half_precision_ends_at_roughness_0_089() -> None:
    alpha = HALF.array(np.array([0.089, 0.088]) ** 2)
    kept = alpha * alpha >= HALF.tiny  # alpha^2 is a normal number
    assert kept.tolist() == [True, False]
    peak = in_precision(textbook_ggx.density, HALF, np.ones(2), np.array([0.1, 0.05]) ** 2)
    assert not np.isfinite(peak).any()  # the printed form is gone even before


@pytest.mark.parametrize("density", [textbook_beckmann.density, beckmann_by_angle.density])
def test_printed_beckmann_forms_lose_the_peak(density: Callable[..., Any]) -> None:
    # c is rounded by 2^-25, and c^2 - 1 or the angle's square divides twice that by alpha^2: 6 %
    assert worst(density, 1e-3) > 0.01
