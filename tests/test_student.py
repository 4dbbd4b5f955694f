"""Student's t against scipy, from the middle to tails of 1e-12 and beyond."""
from __future__ import annotations

import math

import pytest
from scipy import stats

from montecarlo_brdf import student

DOF = [1, 2, 3, 7, 15, 31, 63, 255, 1000]


@pytest.mark.parametrize("dof", DOF)
@pytest.mark.parametrize("t", [1e-3, 0.5, 1.0, 2.0, 4.9, 12.0, 40.0])
def test_tail(t: float, dof: int) -> None:
    assert student.tail(t, dof) == pytest.approx(stats.t.sf(t, dof), rel=1e-11)


@pytest.mark.parametrize("dof", DOF)
@pytest.mark.parametrize("upper", [0.49, 0.25, 0.025, 1e-3, 1e-6, 1e-9, 1e-12])
def test_quantile(upper: float, dof: int) -> None:
    assert student.quantile(upper, dof) == pytest.approx(stats.t.isf(upper, dof), rel=1e-11)
    assert student.tail(student.quantile(upper, dof), dof) == pytest.approx(upper, rel=1e-9)


@pytest.mark.parametrize("dof", DOF)
def test_near_the_middle(dof: int) -> None:
    """1/2 - t density(0); the next term is of order t^3."""
    for t in (1e-5, 1e-9, 1e-16, 1e-170):
        assert student.tail(t, dof) == pytest.approx(0.5 - t * stats.t.pdf(0.0, dof), rel=1e-11)


def test_ends() -> None:
    assert student.tail(0.0, 5) == 0.5
    assert student.tail(math.inf, 5) == student.tail(1e200, 5) == 0.0
    assert student.quantile(0.5, 5) == 0.0
    assert student.quantile(0.01, 0) == math.inf
