"""Branches of a model's code are met on both sides, and where they turn."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.arithmetic.recording import Tape, recording
from montecarlo_brdf.arithmetic.rung import Rung
from montecarlo_brdf.cases import margins
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.points import Points, even
from montecarlo_brdf.checks import positivity

Make = Callable[..., Case]

HEAD = """
class Params(NamedTuple):
    a: float = 0.5
    b: float = 0.125


domain = {"a": (0.0, 1.0), "b": (0.0, 1.0)}


"""
RELATION = """
def f(wo, wi, p):
    return 0.1 if p.a > 2.0 * p.b else 0.2
"""
CLAMP = """
def f(wo, wi, p):
    return 0.001 * p.a / max(wo[2], math.cos(math.radians(88.0)))
"""
NUMBER = """
def f(wo, wi, p):
    return p.a / math.pi

def sample(wo, u, p):
    if u[0] > 0.99:
        return 0.0, 0.0, 1.0
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return wi[2] / math.pi
"""
PRODUCT = """
def f(wo, wi, p):
    c = wo[0] * wi[0] + wo[1] * wi[1] + wo[2] * wi[2]
    return 0.1 if c < 0.123456 * p.a else 0.2
"""
UNFOLLOWED = """
def f(wo, wi, p):
    total = 0.0
    for _ in range(int(4.0 * wo[2]) + 1):
        total += 0.01 * p.a
    return total
"""
NOTHING = """
def f(wo, wi, p):
    return p.a * wo[2] * wi[2]
"""

#: a branch -> its margin
TURNS: dict[str, tuple[str, Callable[[Points], np.ndarray]]] = {
    "a = 2 b": (RELATION, lambda at: at.table[:, 0] - 2.0 * at.table[:, 1]),
    "a clamp at 88 degrees": (CLAMP, lambda at: at.wo[:, 2] - np.cos(np.radians(88.0))),
    "u[0] > 0.99": (NUMBER, lambda at: at.u[:, 0] - 0.99),
}


def found(case: Case) -> Points:
    """What is found where there is something."""
    at = margins.points(case)
    assert at is not None
    return at


@pytest.mark.parametrize("name", TURNS)
def test_a_branch_is_met_exactly_and_on_both_sides(name: str, case_of: Make) -> None:
    """To 1e-14: where the very value is hit, bisection stops some doubles beside it."""
    text, margin = TURNS[name]
    m = margin(found(case_of(HEAD + text)))
    assert np.any(m == 0.0)
    assert np.any((m > 0.0) & (m < 1e-14)) and np.any((m < 0.0) & (m > -1e-14))


def test_what_hangs_on_several_numbers_is_met_on_both_sides(case_of: Make) -> None:
    at = found(case_of(HEAD + PRODUCT))
    m = np.sum(at.wo * at.wi, axis=1) - 0.123456 * at.table[:, 0]
    assert np.any((m >= 0.0) & (m < 1e-14)) and np.any((m < 0.0) & (m > -1e-14))


def test_a_turn_is_told_by_its_line(case_of: Make) -> None:
    text = HEAD + RELATION
    at = found(case_of(text))
    line = 1 + next(k for k, one in enumerate(text.splitlines()) if "p.a > 2.0" in one)
    assert set(at.labels) == {f"; found where line {line + 3} of f turns"}


def test_points_of_turns_are_directions_above_the_horizon(case_of: Make) -> None:
    for text, _ in TURNS.values():
        at = found(case_of(HEAD + text))
        for w in (at.wo, at.wi):
            assert np.abs(np.linalg.norm(w, axis=1) - 1.0).max() < 2e-15 and w[:, 2].min() > 0.0
        assert at.table.min() >= 0.0 and at.table.max() <= 1.0


def test_turns_are_the_same_again(case_of: Make) -> None:
    case = case_of(HEAD + RELATION)
    one, two = found(case), found(case)
    assert all(np.array_equal(a, b) for a, b in zip(one[:4], two[:4], strict=True))


def test_code_without_branches_has_no_turns(case_of: Make) -> None:
    assert margins.points(case_of(HEAD + NOTHING)) is None


def test_code_that_cannot_be_followed_is_asked_all_the_same(case_of: Make) -> None:
    case = case_of(HEAD + UNFOLLOWED, effort=0.03)
    assert margins.points(case) is None
    report = mb.run(case.model, names=["positivity", "reciprocity"], effort=0.03)
    assert {r.check: str(r.verdict) for r in report.results} == {
        "positivity": "pass",
        "reciprocity": "fail",
    }
    assert list(positivity.claims(case))


def test_a_tape_holds_the_margin_of_each_point_and_none_of_those_that_do_not_come_by(
    case_of: Make,
) -> None:
    text = """
def f(wo, wi, p):
    if wo[2] > 0.5:
        return math.sqrt(wi[2])
    return 0.0
"""
    case, tape = case_of(text), Tape(1000)
    at = even(case, 64)
    tape.begin(64)
    Rung(case.model, recording(tape)).f(at.wo, at.wi, case.one)
    branch, root = sorted(tape.margins, key=lambda site: site.position[0] or 0)
    assert np.array_equal(tape.margins[branch], at.wo[:, 2] - 0.5)
    due = np.where(at.wo[:, 2] > 0.5, at.wi[:, 2], np.nan)
    assert np.array_equal(tape.margins[root], due, equal_nan=True)
    assert (branch.operation, root.operation) == ("greater", "sqrt")
