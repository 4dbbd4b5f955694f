"""What a user may write in a BRDF: exceptions, arrays, helpers in other files."""
from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import montecarlo_brdf as mb

Write = Callable[..., Path]


def albedo(path: Path, sampler: str = "cosine") -> Any:
    model = mb.load(str(path))
    return mb.directional_albedo(model, model.parameters(), 30.0, sampler=sampler, samples=4096)


RAISES = """
def f(wo, wi, p):
    if wi[0] > 0.5:
        raise ValueError("too far")
    return 0.1
"""

WITH_ARRAY = """
import numpy as np

def f(wo, wi, p):
    w = np.array([wi[0], wi[1], wi[2]])
    return 0.1 * np.dot(w, w)
"""

WITH_LIBM = """
import math

def f(wo, wi, p):
    return 0.1 * (math.sin(wi[0]) ** 2 + math.cos(wi[0]) ** 2) ** 1.5
"""

WITH_NUMBA = """
import numba

@numba.njit
def helper(x):
    return 0.05 + x

@numba.njit(fastmath=True)
def f(wo, wi, p):
    return helper(0.05)
"""


def test_an_exception_in_a_kernel_is_a_model_error(user_file: Write) -> None:
    with pytest.raises(mb.ModelError, match="rais"):
        albedo(user_file(RAISES))


@pytest.mark.parametrize("text", [WITH_ARRAY, WITH_LIBM, WITH_NUMBA])
def test_arrays_libm_and_jitted_helpers(user_file: Write, text: str) -> None:
    """f = 0.1 in disguise: albedo 0.1 pi, to the rounding of a few operations."""
    for sampler, tolerance in (("cosine", 1e-14), ("uniform", 1e-2)):
        e = albedo(user_file(text), sampler)
        assert e.mean == pytest.approx(0.1 * math.pi, rel=tolerance)


def test_array_code_runs_twice(user_file: Write) -> None:
    """Such kernels are not stored on disk; the second call must still find one."""
    path = user_file(WITH_ARRAY)
    assert albedo(path) == albedo(path)


CLOSURE = """
def scaled(c):
    def f(wo, wi, p):
        return c
    return f

f = scaled({})
"""


@pytest.mark.parametrize("c", [0.1, 0.2])
def test_closures_are_part_of_the_model(user_file: Write, c: float) -> None:
    e = albedo(user_file(CLOSURE.format(c)))
    assert e.mean == pytest.approx(c * math.pi, rel=1e-14)
