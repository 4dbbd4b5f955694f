"""Accumulation of billions of samples, and what hostile integrands do to it.

Blocks and calls merge by `evaluate._push` and `statistics.merged`; 2^40 samples are composed from
the states of their calls, which are what a kernel would have returned, and held against exact sums.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.estimate import evaluate, moments
from montecarlo_brdf.statistics import Moments


def block(values: np.ndarray) -> Moments:
    """The state that the kernel's merge_block leaves after these values."""
    out = [0.0] * moments.STATE
    x = values.tolist()
    for start in range(0, len(x), moments.BLOCK):
        moments.merge_block(x, start, min(moments.BLOCK, len(x) - start), out, 0)
    return Moments(*out)


def total(states: list[Moments]) -> Moments:
    """States of calls merged as `evaluate.run` merges them."""
    stack: list[tuple[int, Moments]] = []
    for state in states:
        evaluate._push(stack, state)
    return evaluate._total(stack)


def exact_mean(*parts: np.ndarray) -> Fraction:
    return sum((Fraction(v) for p in parts for v in p.tolist()), Fraction(0)) / sum(map(len, parts))


@pytest.mark.parametrize("constant", [0.1, 1.0 / 3.0, 1e150, 5e-324])
def test_constant(constant: float) -> None:
    one = Moments(float(evaluate.CHUNK), constant, 0.0, constant)
    many = one
    for _ in range(40 - 17):  # 2^40 samples: 23 doublings of a chunk of 2^17
        many = total([many, many])
    assert many == Moments(2.0**40, constant, 0.0, constant)
    assert block(np.full(5000, constant))[:3] == (5000.0, constant, 0.0)


def test_two_to_the_forty_smooth_samples() -> None:
    # 4,096 different chunks, each standing for 2^28 samples: 2^40 in all, means known exactly
    rng = np.random.default_rng(3)
    means = 0.7 + 0.01 * rng.standard_normal(4096)
    states = [Moments(2.0**28, float(m), 1.0, 1.0) for m in means]
    merged = total(states)
    truth = exact_mean(means)
    # 12 merges, each rounded by 2^-53 relative to values of one sign
    assert abs(Fraction(merged.mean) - truth) <= Fraction(1e-14) * truth
    assert merged.count == 2.0**40


def test_blocks_against_exact_sums() -> None:
    smooth = np.sin(np.linspace(0.0, 3.0, 1 << 17)) + 1.0
    state = block(smooth)
    assert abs(Fraction(state.mean) - exact_mean(smooth)) <= Fraction(1e-15) * 2
    assert state.squares == pytest.approx(len(smooth) * smooth.var(), rel=1e-12)


@pytest.mark.parametrize("scale", [1.0, 1e150, 1e-150])
def test_alternating_and_huge_ranges(scale: float) -> None:
    # error against the mean of |x|: a sum of mixed signs is determined no better by anyone
    alternating = scale * np.where(np.arange(1 << 14) % 2, 1.0, -1.0 + 1e-9)
    ranging = scale * 10.0 ** np.random.default_rng(5).uniform(-100.0, 0.0, 1 << 14)
    for values in (alternating, ranging):
        size = float(np.mean(np.abs(values)))
        assert abs(float(Fraction(block(values).mean) - exact_mean(values))) <= 1e-14 * size


@pytest.mark.parametrize("k", [-0.4, 0.1, 0.5])
def test_minnaert_tails_are_not_believed_or_right(k: float) -> None:
    model = mb.load("minnaert")
    report = mb.furnace(model, model.parameters(k=k), [30.0], samples=2**18, threads=1)
    findings = [f for f in report.results[0].findings if f.quantity == "A"]
    assert [f.verdict for f in findings] == ["pass"]
    if k < 0.0:  # infinite variance under cosine sampling
        assert any("not_used" in e for e in findings[0].estimators if e["estimator"] == "cosine")


@pytest.mark.parametrize("alpha", [1e-4, 1e-3])
def test_near_delta_lobes_never_fail_under_the_wrong_sampler(alpha: float) -> None:
    model = mb.load("ggx")
    report = mb.furnace(
        model, model.parameters(alpha=alpha), [45.0], sampler="cosine", samples=2**16
    )
    assert report.verdict in ("inconclusive", "pass")


@pytest.mark.parametrize("start", [(1 << k) - 2048 for k in (31, 32, 53, 63)])
def test_counters_at_their_boundaries(start: int) -> None:
    """Mean and variance of x for 2^16 independent points from a far index, each within 6 sigma."""
    from montecarlo_brdf.bits import u64
    from montecarlo_brdf.sampling import points

    key = points.replicate_key(u64(99), 0)
    x = np.array([points.independent(key, u64(start + i))[0] for i in range(1 << 12)])
    n = len(x)  # false-alarm rate 2e-9 per test of the mean, about 1e-8 for the variance
    assert abs(x.mean() - 0.5) < 6.0 * math.sqrt(1.0 / 12.0 / n)
    assert abs(((x - 0.5) ** 2).mean() - 1.0 / 12.0) < 6.0 * math.sqrt(1.0 / 180.0 / n)
    assert len(set(x.tolist())) == n


@pytest.mark.parametrize("seed", [0, (1 << 32) - 1, 1 << 32, (1 << 63) - 1, 1 << 63, (1 << 64) - 1])
def test_seeds_at_their_limits(seed: int) -> None:
    model = mb.load("lommel_seeliger")
    e = mb.directional_albedo(model, model.parameters(), 45.0, points="independent", seed=seed,
                              samples=2**14)  # fmt: skip
    mu = math.sqrt(0.5)
    truth = 0.8 * (1.0 - mu * math.log1p(1.0 / mu))
    assert abs(e.mean - truth) < e.half_width(1e-8)


@pytest.mark.parametrize(("samples", "replicates"), [(1, 16), (1, 1), (2, 1), (17, 16)])
def test_hardly_any_samples(samples: int, replicates: int) -> None:
    model = mb.load("lambert")
    e = mb.directional_albedo(
        model, model.parameters(), 45.0, samples=samples, replicates=replicates
    )
    assert e.mean == pytest.approx(0.8, abs=1e-15)
    assert e.stderr == math.inf or e.stderr >= 0.0
