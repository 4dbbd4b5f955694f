"""The polynomials of special.py against mpmath, in Python and in compiled code.

The compiler may reassociate and fuse, so the same points go through both.
"""
from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from montecarlo_brdf import special
from montecarlo_brdf.compile.bind import hole

mp.mp.dps = 40

F: Any = hole()


def run(x: Any, out: Any) -> None:
    for i in range(x.size):
        out[i] = F(x[i])


@functools.cache
def compiled(function: Callable[[float], float]) -> Callable[[Any, Any], None]:
    import numba

    from montecarlo_brdf.compile import compiler

    specialiser = compiler.specialiser(compiler.compiled)
    return numba.njit(**compiler.options())(specialiser.clone(run, {"F": function}))


def both(function: Callable[[float], float], x: Any) -> list[Any]:
    out = np.empty_like(x)
    compiled(function)(x, out)
    return [np.array([function(float(v)) for v in x]), out]


def spread(low: float, high: float, count: int = 3000) -> Any:
    """Evenly spread and, on either side of 0, logarithmically down to 1e-300."""
    rng = np.random.default_rng(1)
    parts = [rng.uniform(low, high, count), np.array([low, high])]
    for sign, end in ((1.0, high), (-1.0, -low)):
        if end > 0:
            near = min(end, 1.0)
            parts.append(sign * near * 10.0 ** -rng.uniform(0, 20, count // 2))
    return np.concatenate(parts)


CASES = [
    # function, truth, points, relative error
    (special.exp, mp.exp, spread(-708.0, 709.0), 4e-16),
    (special.exp2, lambda t: mp.mpf(2) ** t, spread(-1022.0, 1023.0), 4e-16),
    (special.expm1, mp.expm1, spread(-708.0, 709.0), 6e-16),
    (special.log, mp.log, np.concatenate([10.0 ** spread(-307.0, 307.0), spread(0.5, 2.0)]), 6e-16),
    (special.log1p, mp.log1p, spread(-1.0 + 2**-53, 4.0), 8e-16),
    (special.log1p, mp.log1p, 10.0 ** spread(0.0, 299.0), 8e-16),
    (special.asin_low, mp.asin, spread(-math.sqrt(0.5), math.sqrt(0.5)), 3e-16),
    (special.asin, mp.asin, spread(-1.0, 1.0), 5e-16),
    (special.acos, mp.acos, 1.0 - np.abs(spread(0.0, 1.0)), 5e-16),
    (special.acos, mp.acos, spread(-1.0, 0.0), 5e-16),
    (special.sin_half_turn, mp.sinpi, spread(-0.5, 0.5), 5e-16),
]


def error(got: Any, truth: list[Any], relative: bool = True) -> float:
    pairs = [(mp.mpf(float(g)), t) for g, t in zip(got, truth, strict=True)]
    return float(max(abs(g - t) / (abs(t) if relative and t else 1) for g, t in pairs))


@pytest.mark.parametrize(("function", "truth", "x", "bound"), CASES)
def test_relative_error(function: Any, truth: Any, x: Any, bound: float) -> None:
    exact = [truth(mp.mpf(float(v))) for v in x]
    for got in both(function, x):
        assert error(got, exact) < bound


def test_absolute_error_of_cosine() -> None:
    x = spread(-0.5, 0.5)
    for got in both(special.cos_half_turn, x):
        assert error(got, [mp.cospi(mp.mpf(float(v))) for v in x], relative=False) < 3e-16


@pytest.mark.parametrize("n", [0.3, 1.0, 32.5, 1e3, 1e7])
def test_powers_are_as_good_as_their_condition(n: float) -> None:
    d = np.append(10.0 ** -np.random.default_rng(2).uniform(0, 20, 2000), 0.0)
    kept = d[(d < 1.0) & (n * np.log1p(-np.minimum(d, 0.999)) > -700)]
    exact = [(1 - mp.mpf(float(v))) ** mp.mpf(n) for v in kept]
    size = max(1.0, float(np.max(np.abs(n * np.log1p(-kept)))))
    for got in both(lambda v: special.cosine_power(v, n), kept):
        assert error(got, exact) < (4 + 6 * size) * 2.0**-53


def test_ends_and_not_a_number() -> None:
    assert special.exp(-1e300) == special.exp2(-1100.0) == special.exp(-math.inf) == 0.0
    assert special.exp(710.0) == special.expm1(1e10) == math.inf
    assert special.exp(0.0) == 1.0 and special.expm1(0.0) == special.log1p(0.0) == 0.0
    assert special.power(0.0, 3.0) == 0.0 and special.power(0.7, 0.0) == 1.0
    assert special.cosine_power(1.0, 0.0) == 0.0 and special.cosine_power(0.999, 0.0) == 1.0
    assert special.cosine_power(1.5, 3.0) == special.cosine_power(2.0, 0.0) == 0.0
    for function in (special.exp, special.expm1, special.log, special.log1p):
        assert all(math.isnan(v) for v in np.ravel(both(function, np.array([math.nan, math.nan]))))
    assert math.isnan(special.power(math.nan, 2.0))
    assert math.isnan(special.cosine_power(math.nan, 2.0))
