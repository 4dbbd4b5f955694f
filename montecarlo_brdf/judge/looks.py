"""Looks at growing sample sizes, and what lies beyond a tolerance."""
from __future__ import annotations

from montecarlo_brdf.judge.finding import Bound, Verdict

FIRST_LOOK = 1 << 14
GROWTH = 4
#: added to the seed for the fresh stream that must confirm a refutation
FRESH = 1 << 32


def looks(most: int) -> list[int]:
    """Sample sizes of the looks, the last one being all that is allowed."""
    sizes = []
    size = min(FIRST_LOOK, most)
    while size < most:
        sizes.append(size)
        size *= GROWTH
    return [*sizes, most]


def excess(bound: str, difference: float) -> float:
    """How far a number that differs so much from what is expected lies outside its bound."""
    if bound == Bound.EQUAL:
        return abs(difference)
    return -difference if bound == Bound.AT_LEAST else difference


def beyond(deviation: float, slack: float, tolerance: float) -> Verdict:
    """"fail" if a deviation exceeds the tolerance surely, else "inconclusive"."""
    return Verdict.FAIL if deviation - slack > tolerance else Verdict.INCONCLUSIVE
