"""Places of integrals: where somebody asked, at edges and where the code may turn; values known."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.directions import EDGES
from montecarlo_brdf.cases.survey import FEWEST, LAST, Survey, sure, survey

Make = Callable[..., Case]
EFFORT = 0.03

LAMBERT = """
class Params(NamedTuple):
    albedo: float = 0.5
    kind: float = 0.0


domain = {"albedo": (0.0, 1.0), "kind": (0.0, 4.0)}


def f(wo, wi, p):
    return (1.5 if p.kind == 3.0 else 1.0) * p.albedo / math.pi

def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return wi[2] / math.pi
"""


def of(case_of: Make) -> Survey:
    """The survey of a surface that is Lambert's, brighter by half where kind = 3."""
    return survey(case_of(LAMBERT, effort=EFFORT))


def test_integrals_are_those_of_the_place_they_are_of(case_of: Make) -> None:
    at = of(case_of)
    albedo, kind = at.points.table.T
    due = albedo * np.where(kind == 3.0, 1.5, 1.0)
    error = np.abs(at.reflected.mean(axis=1) - due)
    assert np.all(error <= 0.05 * np.maximum(due, 1e-12))
    assert np.abs(at.mass.mean(axis=1) - 1.0).max() < 0.05 and at.undrawn.max() == 0.0


def test_a_place_that_the_code_names_is_the_worst_and_says_what_led_there(case_of: Make) -> None:
    at = of(case_of)
    k = int(np.argmax(sure(at.reflected - 1.0) * (at.reflected.mean(axis=1) > 1.0)))
    there, _ = at.place(k)
    assert there.one.kind == 3.0 and there.one.albedo > 2.0 / 3.0  # type: ignore[attr-defined]
    assert at.source(k).startswith("; found")  # where one of two values is told


def test_a_place_gives_the_direction_exactly(case_of: Make) -> None:
    at = of(case_of)
    for k in range(0, len(at.points.wo), 37):
        there, theta = at.place(k)
        assert there.wo(theta) == tuple(at.points.wo[k])
        assert math.cos(math.radians(theta)) == pytest.approx(at.points.wo[k, 2], abs=1e-14)


def test_places_are_where_somebody_asked_and_at_edges_that_are_visible(case_of: Make) -> None:
    at = of(case_of)
    z = at.points.wo[:, 2]
    assert z.min() >= math.cos(math.radians(LAST)) - 1e-15
    for theta in (t for t in EDGES if t < math.radians(LAST)):
        assert np.any(np.abs(z - math.cos(theta)) < 1e-12)
    asked = np.all(at.points.table == np.array(at.case.one), axis=1)
    for theta in (0.0, 45.0, 80.0):
        assert np.any(asked & (np.abs(z - math.cos(math.radians(theta))) < 1e-12))


def test_checks_share_one_survey(case_of: Make) -> None:
    case = case_of(LAMBERT, effort=EFFORT)
    assert survey(case) is survey(case._replace(theta_o_deg=(80.0,)))
    assert len(survey(case).some) == FEWEST


def test_what_is_sure_is_less_by_two_standard_errors_and_never_nan() -> None:
    rows = np.array([[1.0, 1.0, 1.0, 1.0], [-2.0, -4.0, -2.0, -4.0], [1.0, math.nan, 1.0, 1.0]])
    found = sure(rows)
    assert found[0] == 1.0 and found[1] == pytest.approx(3.0 - 2.0 * math.sqrt(1.0 / 3.0))
    assert found[2] == math.inf
