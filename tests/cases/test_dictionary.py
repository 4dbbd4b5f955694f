"""Numbers of the code, and what is made of them, are met exactly."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.code import functions_of, numbers_in
from montecarlo_brdf.cases.dictionary import Place, Special, points, specials
from montecarlo_brdf.checks import positivity
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Verdict

Make = Callable[..., Case]

MODEL = """
TABLE = (0.125, 77.5)


class Params(NamedTuple):
    a: float = 0.5
    b: float = 0.25
    kind: float = 0.0


domain = {"a": (0.0, 1.0), "b": (0.0, 1.0), "kind": (0.0, 4.0)}
isotropic = False


def scaled(x):
    return 0.0375 * x


def f(wo, wi, p):
    return scaled(p.a) + p.b * TABLE[0] / 31.25


def sample(wo, u, p):
    r = math.sqrt(u[0])
    phi = 2.0 * math.pi * u[1] if u[2] < 0.8125 else 0.0
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
"""

#: what a point can only meet on purpose
CONDITIONS: dict[str, Callable[..., np.ndarray]] = {
    "a constant of the code": lambda at: at.table[:, 0] == 0.0375,
    "a constant's square root": lambda at: at.table[:, 0] == 0.125**0.5,
    "a whole number": lambda at: at.table[:, 2] == 3.0,
    "two equal parameters": lambda at: at.table[:, 0] == at.table[:, 1],
    "a sum of 1": lambda at: at.table[:, 0] == 1.0 - at.table[:, 1],
    "wo in a plane of the frame": lambda at: at.wo[:, 0] == 0.0,
    "wi in the other": lambda at: at.wi[:, 1] == 0.0,
    "a cosine": lambda at: at.wo[:, 2] == 0.8125,
    "a number u": lambda at: at.u[:, 2] == 0.8125,
    "normal incidence": lambda at: at.wi[:, 2] == 1.0,
    "wi = wo": lambda at: np.all(at.wi == at.wo, axis=1),
    "the mirror direction": lambda at: np.all(at.wi == at.wo * (-1.0, -1.0, 1.0), axis=1),
}


def test_numbers_of_all_functions_and_tables_are_found(case_of: Make) -> None:
    model = case_of(MODEL).model
    assert {g.__name__ for g in functions_of(model)} == {"f", "sample", "pdf", "scaled"}
    assert {0.0375, 31.25, 0.8125, 0.125, 77.5, 2.0} <= set(numbers_in(model))


def test_a_number_is_found_once(case_of: Make) -> None:
    found = numbers_in(case_of(MODEL).model)
    assert len(found) == len(set(found)) and min(found) > 0.0


@pytest.mark.parametrize("name", CONDITIONS)
def test_a_special_value_is_met_exactly(name: str, case_of: Make) -> None:
    assert np.count_nonzero(CONDITIONS[name](points(case_of(MODEL)))) >= 2


def test_a_point_lies_where_its_label_says(case_of: Make) -> None:
    only = [Special(Place.PARAMETER, 0.0375, 0), Special(Place.NUMBER, 0.25, 1)]
    at = points(case_of(MODEL), 64, only)
    assert list(np.unique(at.label)) == [0, 1] and len(at.label) == 128
    assert np.all(at.table[at.label == 0, 0] == 0.0375) and np.all(at.u[at.label == 1, 1] == 0.25)
    assert at.labels[0] == "; found at a = 0.0375, which the code may ask for"


def test_equal_parameters_are_tried_at_any_value(case_of: Make) -> None:
    case = case_of(MODEL)
    related = [s for s in specials(case) if s.place is Place.RATIO and s.value == 0.0]
    assert {s[2:] for s in related} == {(j, k) for j in range(3) for k in range(3) if j != k}
    at = points(case, 64, [s for s in related if s[2:] == (0, 1)])
    assert np.all(at.table[:, 0] == at.table[:, 1]) and len(set(at.table[:, 0])) > 10


def test_values_stay_in_the_ranges(case_of: Make) -> None:
    case = case_of(MODEL)
    at = points(case)
    for k, name in enumerate(case.one._fields):
        low, high = case.model.domain[name]
        assert at.table[:, k].min() >= low and at.table[:, k].max() <= high


def test_parameters_that_are_not_free_keep_their_values(case_of: Make) -> None:
    case = case_of(MODEL, free=())
    assert not any(s.place in (Place.PARAMETER, Place.RATIO) for s in specials(case))
    assert np.all(points(case).table == np.array(case.one))


CONDITION = """
class Params(NamedTuple):
    a: float = 0.5
    b: float = 0.25
    kind: float = 0.0


domain = {{"a": (0.0, 1.0), "b": (0.0, 1.0), "kind": (0.0, 3.0)}}
isotropic = False


def f(wo, wi, p):
    return -0.1 if {} else 0.1
"""


@pytest.mark.parametrize("condition", ["p.kind == 2.0", "p.a == p.b", "wo[0] == 0.0", "False"])
def test_what_is_wrong_at_a_special_value_alone_is_refuted(condition: str, case_of: Make) -> None:
    case = case_of(CONDITION.format(condition), effort=0.03)
    plan = Plan(samples=1024, effort=0.03)
    found = {decide(claim, plan).verdict for claim in positivity.claims(case)}
    assert (Verdict.FAIL in found) == (condition != "False")
