"""The ladder itself: branches on arrays, types that stay what they are, truths that are true."""

from __future__ import annotations

import math

import numpy as np
import pytest
from columns import in_precision

from montecarlo_brdf import contract, loading
from montecarlo_brdf.arithmetic import rung as ladder
from montecarlo_brdf.arithmetic import types as arithmetic
from montecarlo_brdf.arithmetic.rung import Rung
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.stability import designed

SINGLE, DOUBLE, EXACT = (
    arithmetic.precision("float32"),
    arithmetic.precision("float64"),
    arithmetic.exact(),
)


def branching(x: float, y: float) -> float:
    if x < y and not y > 3.0:
        return max(x, 0.25)
    total = 0.0
    while total < x:
        total += 1.0
    return total if x >= 0.0 else abs(y)


def test_branches_mean_what_they_mean_for_one_number() -> None:
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-2.0, 6.0, (2, 500))
    many = in_precision(branching, DOUBLE, x, y)
    assert many.tolist() == [branching(a, b) for a, b in zip(x, y, strict=True)]


@pytest.mark.parametrize(
    "name", ["lambert", "ggx", "phong", "oren_nayar", "minnaert", "eon", "beckmann"]
)
def test_double_is_the_plain_function(name: str) -> None:
    model = loading.load(name)
    points = designed.directions(DOUBLE, 0.3, True)
    some = slice(None, None, 41)
    wo, wi, p = points.wo[some], points.wi[some], model.parameters()
    many = Rung(model, DOUBLE).f(wo, wi, ladder.rounded(p, DOUBLE))
    for a, b, value in zip(wo.tolist(), wi.tolist(), many, strict=True):
        try:
            one = model.f(tuple(a), tuple(b), model.prepared(p))
        except (ZeroDivisionError, ValueError):
            continue  # Python raises where arithmetic has Inf or NaN
        assert value == one or math.isnan(one)


def widening(wo, wi, p):  # type: ignore[no-untyped-def]
    return np.float64(0.5) * wi[2]


def leaving(wo, wi, p):  # type: ignore[no-untyped-def]
    return float(wi[2])


@pytest.mark.parametrize("f", [widening, leaving])
def test_widening_is_not_silent(f: object) -> None:
    model = contract.build("wide", {"f": f, "np": np})
    up = np.array([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]], dtype=np.float32)
    with pytest.raises(ModelError, match="leaves its precision"):
        Rung(model, SINGLE).f(up, up, model.Params())


@pytest.mark.parametrize("name", sorted(arithmetic.ladder()))
def test_every_model_stays_in_its_precision(name: str) -> None:
    one = arithmetic.precision(name)
    points = designed.directions(one, 0.3, True)
    for model in map(
        loading.load, ["ggx", "phong", "blinn_phong", "minnaert", "eon", "disney_diffuse"]
    ):
        q = ladder.rounded(model.parameters(), one)
        assert Rung(model, one).f(points.wo, points.wi, q).dtype == one.dtype


def test_exact_arithmetic_is_exact() -> None:
    x = np.geomspace(1e-8, 0.5, 20)
    one_minus = in_precision(lambda t: math.sqrt(1.0 - t * t) + math.exp(-t), EXACT, x)
    for t, found in zip(x, one_minus, strict=True):
        assert abs(float(found) - (math.sqrt(1.0 - t * t) + math.exp(-t))) < 5e-16


def test_long_double_keeps_its_digits_as_truth() -> None:
    if "longdouble" not in arithmetic.ladder():
        pytest.skip("long double is double on this machine")
    third = np.longdouble(1.0) / np.longdouble(3.0)
    found = EXACT.array(np.array([third], dtype=np.longdouble))[0]
    assert 1e-21 < abs(float(found * 3 - 1)) < 1e-19
