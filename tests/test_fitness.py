"""Estimators that must not be believed are listed as not used, with the reason."""

from __future__ import annotations

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.checks.fitness import Sight, reason_unfit
from montecarlo_brdf.statistics import Estimate


def nothing(samples: int = 16384) -> Estimate:
    return Estimate(0.0, 0.0, samples, (0.0,) * 16, 0.0, 0.0)


@pytest.mark.parametrize("sampler", ["uniform", "cosine"])
def test_a_lobe_that_was_never_hit(sampler: str) -> None:
    reason = reason_unfit(sampler, nothing(), Sight(1e6, 0.0), None)
    assert reason == f"a lobe that {sampler} sampling did not hit once in 16384 samples"


def test_black_is_black() -> None:
    assert reason_unfit("cosine", nothing(), Sight(0.0, 0.0), None) is None


@pytest.mark.parametrize("seed", [0, 2])
def test_beckmann_too_narrow_to_hit_passes_by_its_own_sampler(seed: int) -> None:
    """It failed for these seeds: uniform sampling found nothing, with no spread."""
    model = mb.load("beckmann")
    p = model.parameters(alpha=1e-4)
    report = mb.furnace(model, p, [0.0], seed=seed, samples=1 << 18)
    assert report.verdict == "pass"
