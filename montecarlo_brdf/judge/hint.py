"""The likely cause of a refuted mean: numbers that name the mistake behind them."""

from __future__ import annotations

import math

from montecarlo_brdf.judge.claim import MeanClaim
from montecarlo_brdf.judge.finding import Bound

#: ratio of what was found to what was expected -> what usually causes it
FACTORS = {
    math.pi: "the factor 1/pi is missing",
    1.0 / math.pi: "the factor 1/pi is applied twice",
    2.0: "a factor 2 too much",
    0.5: "a factor 2 too little",
    4.0: "a factor 4 too much: the 1/4 of the half-vector Jacobian is missing",
    0.25: "a factor 4 too little: the 1/4 of the half-vector Jacobian is applied twice",
    4.0 / math.pi: "pi stands where 4 belongs in the denominator",
    2.0 * math.pi: "a factor 2 pi too much: the pdf of uniform hemisphere sampling",
}
NOT_FINITE = "f is not finite for some direction: look for 1/0 or the root of a negative number"
NOT_FINITE_WEIGHT = (
    "f cos / pdf is not finite for some draw, f by itself is for all other samplers: "
    "look for a pdf of 0 where sample draws"
)
CLOSE = 2e-3


def hint(claim: MeanClaim, value: float, only_own: bool = False) -> str | None:
    """A sentence that names the likely cause of a refuted claim, if the number tells.

    only_own: no other sampler met a value that is not finite.
    """
    if not math.isfinite(value):
        return NOT_FINITE_WEIGHT if only_own else NOT_FINITE
    if claim.diagnosis and (told := claim.diagnosis()):
        return told
    units, close = dict(claim.unit), CLOSE
    expected = claim.expected.value if claim.expected else 0.0
    if claim.bound == Bound.AT_MOST:  # what should reflect 1; a search for the worst is coarse
        units, close = {"1": expected, **units}, 5.0 * CLOSE
    elif expected:
        units = {"expected": expected, **units}
    for name, unit in units.items():
        cause = factor_named(value / unit, close) if unit else None
        if cause:
            return f"{_subject(claim)} / {name} = {cause}"
    return claim.cause() if claim.cause else None


def _subject(claim: MeanClaim) -> str:
    """What was measured, without what is claimed of it."""
    return claim.quantity.removeprefix("worst ").partition(" <=")[0]


def factor_named(ratio: float, close: float = CLOSE) -> str | None:
    """'pi: the factor 1/pi is missing' for a ratio that is close to a telling number."""
    for factor, cause in FACTORS.items():
        if abs(ratio / factor - 1.0) < close:
            return f"{_symbol(factor)}: {cause}"
    return None


def _symbol(factor: float) -> str:
    symbols = {math.pi: "pi", 1.0 / math.pi: "1/pi", 4.0 / math.pi: "4/pi", 2.0 * math.pi: "2 pi"}
    return symbols.get(factor, f"{factor:g}")
