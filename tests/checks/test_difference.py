"""How two values that should be equal are compared."""

from __future__ import annotations

import math

import numpy as np

from montecarlo_brdf.checks._difference import relative


def test_a_deviation_is_relative_to_the_larger_value() -> None:
    one, other = np.array([1.0, -1.0, 0.0, 3.0]), np.array([2.0, 1.0, 0.0, 3.0])
    assert list(relative(one, other)) == [0.5, 2.0, 0.0, 0.0]


def test_small_values_are_held_against_a_share_of_the_largest() -> None:
    one, other = np.array([1.0, 1e-30]), np.array([1.0, 2e-30])
    assert relative(one, other)[1] < 1e-4
    assert relative(one, other, share=1e-40)[1] == 0.5


def test_what_is_not_finite_is_left_to_positivity() -> None:
    one = np.array([math.nan, math.inf, -math.inf, 1.0, 2.0])
    other = np.array([1.0, math.inf, 1.0, 4.0, math.nan])
    assert list(relative(one, other)) == [0.0, 0.0, 0.0, 0.75, 0.0]


def test_nothing_differs_from_nothing() -> None:
    assert list(relative(np.zeros(3), np.zeros(3))) == [0.0, 0.0, 0.0]
    assert list(relative(np.array([5e-324]), np.array([0.0]))) == [5e-324 / 1e-300]
