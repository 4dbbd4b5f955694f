"""Draws counted in compiled code: in the same cells as NumPy finds, and bounds that hold."""
from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks._cells import GROUPS, Cells, norm_bound
from montecarlo_brdf.checks.sampling import TOLERANCE, judged
from montecarlo_brdf.estimate.cells import placed
from montecarlo_brdf.estimate.places import Pointwise


def cells_of(alpha: float, theta: float) -> Cells:
    model = mb.load("ggx")
    case = Case(model, model.parameters(alpha=alpha), [theta], phi_o_deg=30.0)
    return Cells(case, theta, TOLERANCE)


@pytest.mark.parametrize("theta", [0.0, 80.0])
def test_compiled_code_finds_the_same_cells(theta: float) -> None:
    cells = cells_of(0.1, theta)
    u = np.random.default_rng(3).random((1000, 3))
    w = Pointwise(cells.model, cells.p).sample(np.array(cells.wo), u)[0]
    place = np.stack(cells.coordinates.coordinates(w[w[:, 2] > 0.0]), axis=1)
    low, high = cells.parts.low, cells.parts.low + cells.parts.size
    inside = (low <= place[:, None]) & (place[:, None] < high)
    rows, cell = np.nonzero(inside.all(axis=2))
    assert np.array_equal(rows, np.arange(len(place)))  # each lies in one
    assert np.array_equal(placed(cells.numbers, place), cells.group[cell])


def test_groups_hold_about_the_same() -> None:
    """And what they hold is what draws say, to 6 standard errors, beyond which 193 numbers are
    once in 10^6."""
    cells, draws = cells_of(0.1, 50.0), 1 << 18
    expected = cells.probability
    assert len(expected) == GROUPS + 1 and expected.sum() == pytest.approx(1.0)
    assert expected[:-1].min() > 0.2 / GROUPS and expected[:-1].max() < 2.5 / GROUPS
    counts = cells.counts(5, draws)
    assert np.all(np.abs(counts / draws - expected) < 6.0 * np.sqrt(expected / draws))


def test_every_draw_is_counted_once_however_the_work_is_cut() -> None:
    cells, draws = cells_of(1.0, 80.0), 100_001
    counts = cells.counts(7, draws)  # calls of few draws as long as their pace is not known
    assert counts.sum() == draws and counts[-1] > 0.0
    assert np.array_equal(counts, cells.counts(7, draws, threads=3))
    assert not np.array_equal(counts, cells.counts(8, draws))


def test_the_upper_bound_misses_as_seldom_as_it_says() -> None:
    """Counts at a known distance, level 1 %: 20 +- 4.4 misses in 2,000; 50 has P < 1e-7."""
    rng, n, far = np.random.default_rng(11), 1 << 14, 0.1
    expected = np.append(np.full(GROUPS, 1.0 / GROUPS), 0.0)
    tilted = expected * (1.0 + far * np.where(np.arange(GROUPS + 1) % 2, 1.0, -1.0))
    counts = rng.multinomial(n, tilted / tilted.sum(), size=2000)
    missed = sum(judged(c.astype(float), expected, 0.01).upper < far for c in counts)
    assert stats.binom.sf(49, 2000, 0.01) < 1e-7 and missed < 50


@pytest.mark.parametrize("variance", [np.ones(192), np.array([1.0]), 0.5 ** np.arange(20.0)])
def test_the_bound_of_a_norm_is_beyond_what_is_seen(
    variance: np.ndarray, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At level 1e-3, of variances known by 32 estimates: 20 misses in 2,000 have P < 1e-12; and it
    is no more than three times the largest seen."""
    monkeypatch.setattr("montecarlo_brdf.checks._cells.SURELY", 1e-3)
    monkeypatch.setattr("montecarlo_brdf.checks._cells.SIGMAS", float(stats.norm.isf(5e-4)))
    rng, many = np.random.default_rng(2), 32
    rows = rng.normal(size=(2000, many, len(variance))) * np.sqrt(many * variance)
    norms = np.linalg.norm(rows.mean(axis=1), axis=1)
    bounds = [norm_bound(v, many) for v in rows.var(axis=1, ddof=1) / many]
    assert np.count_nonzero(norms > bounds) < 20 and np.median(bounds) < 3.0 * norms.max()
