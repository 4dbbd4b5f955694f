"""The error bar means what it says: standardised errors follow Student's t."""
from __future__ import annotations

import functools

import pytest
from scipy import stats

import montecarlo_brdf as mb

SEEDS = 2000
ALBEDO = 0.8


@functools.cache
def estimates(points: str) -> list[mb.Estimate]:
    """Lambert at 60 degrees by uniform sampling, one estimate per seed."""
    model = mb.load("lambert")
    p = model.parameters(albedo=ALBEDO)
    ask = functools.partial(mb.directional_albedo, model, p, 60.0, sampler="uniform", points=points)
    return [ask(samples=2048, seed=seed) for seed in range(SEEDS)]


@pytest.mark.parametrize("points", ["independent", "sobol"])
def test_standardised_errors_follow_student(points: str) -> None:
    """Kolmogorov-Smirnov at 1e-6."""
    errors = [(e.mean - ALBEDO) / e.stderr for e in estimates(points)]
    uniform = stats.t.cdf(errors, estimates(points)[0].dof)
    assert stats.kstest(uniform, "uniform").pvalue > 1e-6


def test_the_test_sees_a_wrong_error_bar_and_a_small_bias() -> None:
    for factor, bias in ((1.3, 0.0), (1 / 1.3, 0.0), (1.0, 0.3)):
        errors = [factor * (e.mean - ALBEDO) / e.stderr + bias for e in estimates("independent")]
        uniform = stats.t.cdf(errors, estimates("independent")[0].dof)
        assert stats.kstest(uniform, "uniform").pvalue < 1e-6


def test_sobol_points_are_worth_their_name() -> None:
    """Same samples, smaller error: here by a factor of about 30; 3 is certain."""
    mean = {s: sum(e.stderr for e in estimates(s)) / SEEDS for s in ("independent", "sobol")}
    assert mean["sobol"] < mean["independent"] / 3.0


@pytest.mark.parametrize("points", ["independent", "sobol"])
@pytest.mark.parametrize("sampler", ["cosine", "own"])
def test_lambert_without_variance_is_exact(points: str, sampler: str) -> None:
    model = mb.load("lambert")
    p = model.parameters(albedo=ALBEDO)
    e = mb.directional_albedo(model, p, 60.0, sampler=sampler, points=points)
    assert abs(e.mean - ALBEDO) < 1e-15
    assert 0.0 < e.stderr < 1e-15


def test_numbers_do_not_depend_on_the_order_of_questions() -> None:
    model = mb.load("ggx")
    p = model.parameters()
    angles = [0.0, 30.0, 60.0]
    ask = functools.partial(mb.directional_albedo, model, p, samples=1024)
    forwards = [ask(a) for a in angles]
    assert [ask(a) for a in reversed(angles)] == forwards[::-1]
