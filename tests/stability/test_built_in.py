"""The built-in models keep their digits over the whole designed set.

tol = 1e-13 in double and 1e-5 in single, beyond what the inputs determine (stability.errors).
"""

from __future__ import annotations

import pytest

from montecarlo_brdf import loading
from montecarlo_brdf.arithmetic import types as arithmetic
from montecarlo_brdf.stability import designed
from montecarlo_brdf.stability.stress import Loss, loss

DEAR = ("ggx_kulla_conty", "oren_nayar_full")  # more than 7 s each


def stressed(name: str, precision: str) -> Loss:
    model = loading.load(name)
    one = arithmetic.precision(precision)
    return loss(model, designed.parameters(model, quick=True), one, quick=True)


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow if n in DEAR else ()) for n in loading.names()],
)
def test_digits(name: str, precision: str) -> None:
    found = stressed(name, precision)
    worst = found.worst
    assert worst is not None and found.points > 1000
    assert worst.own <= found.tolerance
    assert found.counts == dict.fromkeys(("nan", "inf", "negative", "flushed"), 0)


@pytest.mark.parametrize("name", [n for n in loading.names() if loading.load(n).sample])
def test_samplers_under_hostile_numbers(name: str) -> None:
    draws = stressed_sampler(name)
    assert set(draws.counts.values()) == {0}
    assert draws.length <= 32 * 2.0**-52


def stressed_sampler(name: str):  # type: ignore[no-untyped-def]
    from montecarlo_brdf.stability import sampling

    model = loading.load(name)
    sets = designed.parameters(model, quick=True)
    draws = sampling.draws(model, sets, arithmetic.precision("float64"))
    assert draws is not None
    return draws
