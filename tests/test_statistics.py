"""Estimates: how they print, merge, and never claim more digits than rounding leaves."""
from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.statistics import (
    FLOOR,
    HIDDEN,
    Moments,
    estimate,
    merged,
    quantile,
    tail,
    with_error,
)

PRINTED = [
    (0.688993, 0.00076, "0.68899(76)"),
    (0.688993, 0.0076, "0.6890(76)"),
    (1.0, 1e-15, "1.0000000000000000(10)"),
    (0.8 - 1.1e-16, FLOOR * (0.8 - 1.1e-16), "0.8(0)"),
    (-1.25, FLOOR, "-1.25(0)"),
    (123.456, 7.8, "123.5(78)"),
    (12345.6, 78.0, "12346(78)"),
    (-0.5, 0.0099996, "-0.500(10)"),
    (0.5, 0.0, "0.5(0)"),
    (0.0, 1e-5, "0.000000(10)"),
    (3e-316, 1e-318, "3.000(10)e-316"),
    (0.0, 1e-40, "0.0(10)e-40"),
    (2e300, 3e298, "2.000(30)e+300"),
    (-7.0 / 3e9, 1e-17, "-2.333333333(10)e-09"),
    (1e-30, 0.0, "1e-30(0)"),
    (0.5 * math.pi, 0.0, "1.5707963(0)"),
    (1145.91617203834, 0.0, "1145.9162(0)"),
    (1.36509267896942e-09, 0.0, "1.4e-09(0)"),
    (4.20488e-40, 1.6e-45, "4.204880(16)e-40"),
    (4.20488e-7, 1.6e-9, "4.205(16)e-07"),
    (math.nan, 1.0, "nan"),
    (math.inf, math.nan, "inf"),
    (0.3, math.nan, "0.3"),
]


@pytest.mark.parametrize(("value", "error", "text"), PRINTED)
def test_printing(value: float, error: float, text: str) -> None:
    shown = with_error(value, error)
    assert shown == text


def moments_of(x: np.ndarray) -> Moments:
    return Moments(x.size, float(x.mean()), float(((x - x.mean()) ** 2).sum()), float(x.max()))


SIZES = [(1,), (1, 1), (3, 1, 4, 1, 5), (1000, 1, 1, 1), tuple(range(1, 40))]


@pytest.mark.parametrize("sizes", SIZES)
def test_merging_is_as_good_as_all_at_once(sizes: tuple[int, ...]) -> None:
    rng = np.random.default_rng(5)
    parts = [rng.normal(1e3, 1.0, n) for n in sizes]
    got, whole = merged([moments_of(p) for p in parts]), moments_of(np.concatenate(parts))
    assert got.count == whole.count and got.largest == whole.largest
    assert got.mean == pytest.approx(whole.mean, rel=1e-14)
    # a deviation carries the rounding of a mean of 1e3: 1e-13 relative to 1, doubled by squaring
    assert got.squares == pytest.approx(whole.squares, rel=1e-11, abs=1e-10)


def test_merging_keeps_a_constant_exact() -> None:
    total = merged([Moments(n, 0.1, 0.0, 0.1) for n in (1024, 1024, 7)])
    assert total == Moments(2055, 0.1, 0.0, 0.1)


def test_mean_and_error_bar_of_replicates() -> None:
    means = [1.0, 2.0, 4.0, 5.0]
    e = estimate([Moments(10, m, 0.0, m) for m in means])
    assert e.mean == 3.0 and e.samples == 40 and e.dof == 3 and e.replicates == tuple(means)
    assert e.stderr == pytest.approx(np.std(means, ddof=1) / 2.0, rel=1e-15)
    assert e.half_width(0.05) == quantile(0.025, 3) * e.stderr
    assert e.second_moment == pytest.approx(np.mean(np.square(means)), rel=1e-15)
    assert e.largest == 5.0
    assert str(e) == with_error(e.mean, e.stderr)


def test_no_spread_leaves_the_floor() -> None:
    e = estimate([Moments(8, 0.8, 0.0, 0.8)] * 16)
    assert e.stderr == FLOOR * 0.8 > 0.0
    assert estimate([Moments(8, 0.0, 0.0, 0.0)] * 16).stderr == 0.0  # zero is exact


def test_nearly_equal_values_do_not_make_a_small_error_bar() -> None:
    """What is drawn once in 10^6 is not seen in 128 samples, and may change the mean by 1/128."""
    close = [Moments(8, 0.8 * (1.0 + 1e-6 * (k % 2)), 1e-12, 0.8) for k in range(16)]
    assert estimate(close).stderr == HIDDEN * estimate(close).mean / 128
    apart = [Moments(8, 0.8 * (1.0 + 0.5 * (k % 2)), 8.0, 0.8) for k in range(16)]
    assert estimate(apart).stderr == pytest.approx(0.2 / math.sqrt(15.0), rel=1e-12)


def test_the_least_error_bar_covers_what_can_hide() -> None:
    """At any level and for 16 or 64 replicates, t HIDDEN/N >= log(1/level)/N: the probability at
    which an event stays unseen in N draws."""
    for dof in (15, 63):
        for level in (0.05, 1e-3, 1e-6, 1e-9, 1e-11):
            assert HIDDEN * quantile(level / 2.0, dof) >= -math.log(level)


def test_one_replicate_has_no_error_bar() -> None:
    e = estimate([Moments(8, 0.8, 1.0, 0.8)])
    assert e.stderr == math.inf and e.dof == 0 and e.half_width(0.01) == math.inf


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_bad_sample_spoils_the_estimate_visibly(bad: float) -> None:
    e = estimate([Moments(8, 0.8, 0.0, 0.8), Moments(8, bad, 0.0, 0.8)])
    assert math.isnan(e.mean) and math.isnan(e.stderr)


def test_effective_samples() -> None:
    assert estimate([Moments(8, 0.8, 0.0, 0.8)] * 2).effective_samples() == pytest.approx(16)
    assert estimate([Moments(8, 0.0, 0.0, 0.0)] * 2).effective_samples() == 0.0


def test_streams_depend_on_content_only() -> None:
    names = [("lambert", 0.1), ("lambert", 0.2), ("ggx", 0.1), ("ggx", 0.1, "cosine"), ("ggx0.1",)]
    forwards = [stream(7, *n) for n in names]
    assert [stream(7, *n) for n in reversed(names)] == forwards[::-1]
    assert len({*forwards, *(stream(8, *n) for n in names)}) == 10
    assert all(0 <= key < 1 << 64 for key in forwards)
    assert stream(0, "a", "b") != stream(0, "ab") != stream(0, "a\x1fb", "")


@pytest.mark.parametrize("value", [1e152, 1e160, 1e-200])
def test_squares_beyond_the_range_of_numbers_are_no_crash(value: float) -> None:
    means = [value * (1.0 + 0.1 * k) for k in range(16)]
    e = estimate([Moments(64.0, m, 64.0 * (0.1 * m) * m, 2.0 * m) for m in means])
    assert e.mean == pytest.approx(1.75 * value)
    assert e.effective_samples() >= 0.0 or math.isnan(e.effective_samples())
    assert estimate([Moments(64.0, value, -math.inf, 1.0), Moments(64.0, value, math.inf, 1.0)])


# Student's t against scipy, from the middle to tails of 1e-12 and beyond --------------------------

DOF = [1, 2, 3, 7, 15, 31, 63, 255, 1000]


@pytest.mark.parametrize("dof", DOF)
@pytest.mark.parametrize("t", [1e-3, 0.5, 1.0, 2.0, 4.9, 12.0, 40.0])
def test_tail(t: float, dof: int) -> None:
    assert tail(t, dof) == pytest.approx(stats.t.sf(t, dof), rel=1e-11)


@pytest.mark.parametrize("dof", DOF)
@pytest.mark.parametrize("upper", [0.49, 0.25, 0.025, 1e-3, 1e-6, 1e-9, 1e-12])
def test_quantile(upper: float, dof: int) -> None:
    assert quantile(upper, dof) == pytest.approx(stats.t.isf(upper, dof), rel=1e-11)
    assert tail(quantile(upper, dof), dof) == pytest.approx(upper, rel=1e-9)


@pytest.mark.parametrize("dof", DOF)
def test_near_the_middle(dof: int) -> None:
    """1/2 - t density(0); the next term is of order t^3."""
    for t in (1e-5, 1e-9, 1e-16, 1e-170):
        assert tail(t, dof) == pytest.approx(0.5 - t * stats.t.pdf(0.0, dof), rel=1e-11)


def test_ends() -> None:
    assert tail(0.0, 5) == 0.5
    assert tail(math.inf, 5) == tail(1e200, 5) == 0.0
    assert quantile(0.5, 5) == 0.0
    assert quantile(0.01, 0) == math.inf
