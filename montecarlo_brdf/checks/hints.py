"""Likely causes: numbers that name the mistake behind them."""
from __future__ import annotations

import math

from montecarlo_brdf.checks.claim import MeanClaim

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
CLOSE = 2e-3


def hint(claim: MeanClaim, value: float) -> str | None:
    """A sentence that names the likely cause of a refuted claim, if the number tells."""
    if not math.isfinite(value):
        return "f is not finite for some direction: look for a division by zero or a root of a negative"
    units = dict(claim.unit)
    if claim.expected is not None and claim.bound == "equal" and claim.expected.value:
        units = {"expected": claim.expected.value, **units}
    for name, unit in units.items():
        cause = factor_named(value / unit)
        if cause:
            return f"{claim.quantity.split()[0]} / {name} = {cause}"
    return None


def factor_named(ratio: float) -> str | None:
    """'pi: the factor 1/pi is missing' for a ratio that is close to a telling number."""
    for factor, cause in FACTORS.items():
        if abs(ratio / factor - 1.0) < CLOSE:
            return f"{_symbol(factor)}: {cause}"
    return None


def _symbol(factor: float) -> str:
    symbols = {math.pi: "pi", 1.0 / math.pi: "1/pi", 4.0 / math.pi: "4/pi", 2.0 * math.pi: "2 pi"}
    return symbols.get(factor, f"{factor:g}")
