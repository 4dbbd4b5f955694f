"""Lines that no check runs are told, and no others."""

from __future__ import annotations

import sys
from collections.abc import Callable

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.lines import total, unrun
from montecarlo_brdf.cases.look import look
from montecarlo_brdf.checks import coverage
from montecarlo_brdf.judge.claim import Limit

Make = Callable[..., Case]
EFFORT = 0.02

HEAD = """
class Params(NamedTuple):
    a: float = 0.5


domain = {"a": (0.0, 1.0)}


"""
NEVER = """
def strange(x):
    y = x + 1.0
    return y

def f(wo, wi, p):
    if p.a > 1.5:
        return strange(p.a)
    if p.a == 0.3125:
        return 0.1
    return 0.1 * p.a
"""
GUARDED = """
def f(wo, wi, p):
    if wo[2] <= 0.0 or wi[2] <= 0.0:
        return 0.0
    return 0.1 * p.a
"""
RAISING = """
def f(wo, wi, p):
    if p.a == 0.0:
        return 1.0 / p.a
    return 0.1 * p.a
"""
PREPARED = """
class Ready(NamedTuple):
    b: float


def prepare(p):
    if p.a < 0.5:
        return Ready(0.1)
    return Ready(0.2)

def f(wo, wi, p):
    return 0.1 if p.b < 0.15 else 0.2
"""


def told(case: Case) -> list[str]:
    """What is said of lines that were not run."""
    return [c.note or "" for c in coverage.claims(case) if isinstance(c, Limit)]


def test_lines_that_were_never_run_are_told_with_their_text(case_of: Make) -> None:
    text = HEAD + NEVER
    number = {line.strip(): k + 4 for k, line in enumerate(text.splitlines())}
    first, call = number["y = x + 1.0"], number["return strange(p.a)"]
    never = "never run, not even by a search for it"
    assert told(case_of(text, effort=EFFORT)) == [
        f"lines {first}-{first + 1} of strange were {never} (y = x + 1.0)",
        f"line {call} of f was {never} (return strange(p.a))",
    ]


def test_how_many_lines_were_run_is_counted(case_of: Make) -> None:
    case = case_of(HEAD + NEVER, effort=EFFORT)
    assert total(case.model) == 7
    assert {(c.value, c.samples) for c in coverage.claims(case)} == {(4.0, 7)}


def test_a_guard_against_directions_below_the_horizon_is_not_told(case_of: Make) -> None:
    case = case_of(HEAD + GUARDED, effort=EFFORT)
    assert unrun(look(case)) == [] and told(case) == [""]


def test_a_line_at_which_plain_python_raises_was_run(case_of: Make) -> None:
    assert told(case_of(HEAD + RAISING, effort=EFFORT)) == [""]


def test_lines_of_prepare_count_where_it_is_followed(case_of: Make) -> None:
    assert told(case_of(HEAD + PREPARED, effort=EFFORT)) == [""]


def test_who_traces_already_goes_on(case_of: Make) -> None:
    def mine(*_: object) -> None:
        """A tracer as a debugger's."""

    before = sys.gettrace()
    sys.settrace(mine)
    try:
        unrun(look(case_of(HEAD + NEVER, effort=EFFORT)))
        assert sys.gettrace() is mine
    finally:
        sys.settrace(before)
