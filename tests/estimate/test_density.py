"""The density of draws by the roots of the sampler: exact, whatever the map is."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import pointwise
from montecarlo_brdf.estimate.density import Density, density, inner
from montecarlo_brdf.vectors import from_degrees

TESTS = Path(__file__).parents[1]
N = 1024


def of(name: str, theta: float = 45.0, **changed: float) -> tuple[Density, Any]:
    """The density of N draws, and what pdf says of it, where it is known."""
    model = mb.load(str(TESTS / f"{name}.py") if "/" in name else name)
    p, wo = model.parameters(**changed), from_degrees(theta, 130.0)
    found = density(model, p, wo, inner(np.random.default_rng(1), N))
    if model.pdf is None:
        return found, None
    pdf = pointwise(model, p).pdf(np.array(wo), np.nan_to_num(found.w, nan=1.0))
    return found, pdf[~np.isnan(found.density)] / found.density[~np.isnan(found.density)]


@pytest.mark.parametrize(
    ("name", "roots"),
    [("concentric_disk", 1.0), ("azimuth_folded", 2.0), ("azimuth_in_slices", 1.0)],
)
def test_one_root_or_several_pdf_is_the_density(name: str, roots: float) -> None:
    found, ratio = of(f"honest/{name}")
    assert found.unknown is None and abs(found.roots.mean() - roots) < 0.03  # near folds
    assert np.quantile(np.abs(ratio - 1.0), 0.95) < 1e-5  # a pole's (STEP/u)^2/8, at u = MARGIN
    assert ratio.min() > 1.0 - 1e-6  # a root that is missed makes the density smaller, never larger


@pytest.mark.parametrize("theta", [0.0, 45.0, 89.9])
@pytest.mark.parametrize("alpha", [1e-3, 1.0])
def test_sharp_and_grazing_lobes(alpha: float, theta: float) -> None:
    _, ratio = of("ggx", theta, alpha=alpha)
    assert np.quantile(np.abs(ratio - 1.0), 0.99) < 1e-5 and ratio.min() > 1.0 - 1e-6


def test_lobes_each_have_their_density() -> None:
    """0.98 and 0.02 of the draws, of lobes whose pdf are known by themselves."""
    found, ratio = of("0.98 lambert + 0.02 ggx")
    assert sorted(np.round(found.shares, 9)) == [0.02, 0.98]
    k = int(np.argmax(found.shares))
    up = ~np.isnan(found.density)
    off = found.lobes[up, k] / (found.w[up, 2] / math.pi) - 1.0
    assert np.quantile(np.abs(off), 0.99) < 1e-5 and off.max() < 1e-6
    assert np.quantile(np.abs(ratio - 1.0), 0.95) < 1e-5 and ratio.min() > 1.0 - 1e-6


def test_a_weight_may_be_right_on_average() -> None:
    found, ratio = of("honest/weight_of_the_lobe_drawn")
    model = mb.load(str(TESTS / "honest/weight_of_the_lobe_drawn.py"))
    f = pointwise(model, model.parameters()).f(np.array(from_degrees(45.0, 130.0)), found.w)
    due = f * found.w[:, 2] / found.density
    up = ~np.isnan(found.density)
    assert np.quantile(np.abs(found.mean_weight / due - 1.0)[up], 0.95) < 1e-5
    assert np.median(np.abs(found.weight / due - 1.0)[up]) > 0.01


def test_draws_counted_once_of_two() -> None:
    """phong_folded counts one of two roots, where the lobe reaches below the horizon."""
    _, ratio = of("mutants/phong_folded", 89.9)
    assert np.quantile(ratio, 0.1) == pytest.approx(0.5, abs=1e-2)
