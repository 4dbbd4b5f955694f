"""The points that all laws are asked at: directions are what they should be, and the same again."""

from __future__ import annotations

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases import points
from montecarlo_brdf.cases.case import Case, search_range, searched
from montecarlo_brdf.cases.directions import HIGHEST_COSINE, MIRROR
from montecarlo_brdf.cases.look import look
from montecarlo_brdf.cases.points import EVEN, FEWEST, Points, cosines, direction, edges, even

EPS = 2.0**-52
MODELS = ["ggx_anisotropic", "lambert", "phong"]
N = 4096


def of(name: str, **changed: object) -> Case:
    """The case of a built-in model, its parameters free."""
    model = mb.load(name)
    case = Case(model, model.parameters(), (0.0, 45.0), free=searched(model, {}))
    return case._replace(**changed)


def beside_1(w: np.ndarray) -> float:
    """How far the lengths of directions are from 1 at most."""
    return float(np.abs(np.sqrt(np.sum(w.astype(np.longdouble) ** 2, axis=1)) - 1.0).max())


def same(a: Points, b: Points) -> bool:
    """Whether all numbers of two sets are the same."""
    return all(np.array_equal(x, y) for x, y in zip(a[:4], b[:4], strict=True))


def test_directions_are_unit_vectors_however_near_to_horizon_and_normal() -> None:
    t = np.linspace(0.0, 1.0, N, endpoint=False)
    w = direction(cosines(t), 7.0 * t)
    assert beside_1(w) < 2.0 * EPS
    assert w[:, 2].min() < 2.0 * HIGHEST_COSINE and w[:, 2].max() > 1.0 - 1e-6


@pytest.mark.parametrize("name", MODELS)
def test_points_are_above_the_horizon_and_of_unit_length(name: str) -> None:
    for at in (even(of(name), N), edges(of(name))):
        for w in (at.wo, at.wi):
            assert beside_1(w) < 5.0 * EPS and w[:, 2].min() > 0.0
        assert at.u.min() >= 0.0 and at.u.max() < 1.0


@pytest.mark.parametrize("name", MODELS)
def test_parameters_stay_in_their_ranges_and_meet_both_ends(name: str) -> None:
    case = of(name)
    table = even(case, N).table
    for k, field in enumerate(case.one._fields):
        low, high = search_range(case.model, field) or (getattr(case.one, field),) * 2
        assert table[:, k].min() == low and table[:, k].max() == high


def test_a_quarter_of_the_points_has_the_parameters_asked_about() -> None:
    case = of("ggx_anisotropic")
    assert np.mean(np.all(even(case, N).table == np.array(case.one), axis=1)) >= 0.25


def test_lobes_are_met_exactly_and_that_of_the_mirror_an_ulp_beside() -> None:
    at = even(of("phong"), N)
    retro, mirror = (np.abs(at.wi - c).max(axis=1) for c in (at.wo, at.wo * MIRROR))
    assert min(np.count_nonzero(off == 0.0) for off in (retro, mirror)) > 20
    assert np.count_nonzero((mirror > 0.0) & (mirror < 3.0 * EPS)) > 20


def test_points_are_the_same_again_and_others_with_another_seed_or_purpose() -> None:
    case = of("ggx")
    assert same(even(case, N), even(case, N)) and same(edges(case), edges(case))
    assert not same(even(case, N), even(case._replace(seed=1), N))
    assert not same(even(case, N), even(case, N, "turns"))


def test_labels_of_joined_points_are_those_of_their_part() -> None:
    parts = [even(of("lambert"), 4) for _ in range(2)]
    labels = np.array([0, 1, 1, 0])
    named = [at.labelled(labels, (f"{k} a", f"{k} b")) for k, at in enumerate(parts)]
    both = points.joined(named)
    assert [both.labels[k] for k in both.label] == [
        f"{k} {'ab'[j]}" for k in (0, 1) for j in labels
    ]


def test_a_look_of_little_effort_is_of_few_points_and_shared() -> None:
    little = of("lambert", effort=0.02)
    found = look(little)
    assert FEWEST <= np.count_nonzero(found.points.label == 0) < EVEN // 4
    assert look(little._replace(theta_o_deg=(80.0,))) is found
    assert np.array_equal(found.f, found.values(found.model.f, found.points.wo, found.points.wi))
    assert float(np.abs(found.f * np.pi - found.points.table[:, 0]).max()) < 2.0 * EPS
