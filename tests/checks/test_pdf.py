"""A user's own sample and pdf gone wrong: a finding each, or a sentence before anything runs."""
from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.judge.finding import Finding
from montecarlo_brdf.testing import as_model
from montecarlo_brdf.verify.run import run


def half(wo: Any, wi: Any, p: Any) -> float:
    return 0.5 / math.pi


def density(wo: Any, wi: Any, p: Any) -> float:
    return wi[2] / math.pi


def cosine(wo: Any, u: Any, p: Any) -> Any:
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def too_long(wo: Any, u: Any, p: Any) -> Any:
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return 1.001 * r * math.cos(phi), 1.001 * r * math.sin(phi), 1.001 * math.sqrt(1.0 - u[0])


def sometimes_nan(wo: Any, u: Any, p: Any) -> Any:
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    z = math.sqrt(1.0 - u[0])
    if u[0] > 0.99:
        z = z * math.inf * 0.0
    return r * math.cos(phi), r * math.sin(phi), z


def below(wo: Any, u: Any, p: Any) -> Any:
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), -math.sqrt(1.0 - u[0])


def half_below(wo: Any, u: Any, p: Any) -> Any:
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    side = 1.0 if u[2] < 0.5 else -1.0
    return r * math.cos(phi), r * math.sin(phi), side * math.sqrt(1.0 - u[0])


def one_side(wo: Any, wi: Any, p: Any) -> float:
    return 2.0 * wi[2] / math.pi if wi[0] > 0.0 else 0.0


def nowhere(wo: Any, wi: Any, p: Any) -> float:
    return 0.0


def refuted(sample: Any, pdf: Any) -> list[Finding]:
    model = as_model(SimpleNamespace(f=half, sample=sample, pdf=pdf))
    report = run(model, names=["pdf"], theta_o_deg=(30.0,), samples=1 << 16)
    return [f for r in report.results for f in r.findings if f.verdict == "fail"]


@pytest.mark.parametrize(
    ("sample", "pdf", "quantity", "hint"),
    [
        (too_long, density, "drawn directions at fault", "draws not of unit length"),
        (sometimes_nan, density, "drawn directions at fault", "draws not finite"),
        (below, density, "int pdf + rejected", "a factor 2 too much"),
        (half_below, density, "int pdf + rejected", None),
        (cosine, one_side, "drawn directions at fault", "a pdf that is not positive"),
        (cosine, nowhere, "drawn directions at fault", "a pdf that is not positive"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_findings(sample: Any, pdf: Any, quantity: str, hint: str | None) -> None:
    found = {f.quantity: f for f in refuted(sample, pdf)}
    assert quantity in found
    assert hint is None or hint in str(found[quantity].hint)
    assert all(f.reproduce for f in found.values())


def test_an_honest_sampler_passes() -> None:
    assert refuted(cosine, density) == []


def pair(wo: Any, u: Any, p: Any) -> Any:
    return u[0], u[1]


def nothing(wo: Any, u: Any, p: Any) -> Any:
    return None


def greedy(wo: Any, u: Any, p: Any) -> Any:
    return u[0], u[1], u[3]


def words(wo: Any, u: Any, p: Any) -> Any:
    return "x", "y", "z"


@pytest.mark.parametrize(
    ("sample", "told"),
    [
        (pair, r"must return \(x, y, z\) or \(x, y, z, weight\), not a value of .* of length 2"),
        (nothing, "must return .* not None"),
        (greedy, r"raised IndexError .*u has 3 numbers"),
        (words, "sample of model .* must return a number, not a value of type str"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_sentences(sample: Any, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        refuted(sample, density)
