"""A repair: what it mends, how simple it is, and what is said if it does."""

from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.diagnosis.laws import Divisor
from montecarlo_brdf.judge.diagnosis import Part


class Repair(NamedTuple):
    """With it, all laws of `mends` hold that did not."""

    part: Part
    penalty: float
    sentence: str
    mends: frozenset[Part]
    divisor: Divisor | None = None  # of pdf, which f may need too


def repair(
    part: Part, penalty: float, sentence: str, *also: Part, divisor: Divisor | None = None
) -> Repair:
    """A repair of one part, and what else it mends."""
    return Repair(part, penalty, sentence, frozenset((part, *also)), divisor)
