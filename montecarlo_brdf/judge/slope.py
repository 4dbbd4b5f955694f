"""Judging how fast an error falls: the interval of a slope against what is claimed."""
from __future__ import annotations

import math

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Slope, SlopeClaim
from montecarlo_brdf.judge.finding import Bound, Finding, Verdict

LEVEL = 1e-6  # chance that a true claim is refuted
SHOWN = 0.05  # of the interval that is shown and must lie below the claim to hold it


def slope_finding(claim: SlopeClaim, plan: Plan) -> Finding:
    """Held if the shown interval lies below the claim, refuted if that of LEVEL lies above it."""
    found, expected = claim.measure(plan), claim.expected
    return Finding(
        claim.quantity,
        dict(claim.where),
        _verdict(found, expected.value + claim.tolerance),
        Bound.AT_MOST,
        found.value,
        found.stderr,
        expected=expected.value,
        tolerance=claim.tolerance,
        level=LEVEL,
        samples=found.samples,
        reference=expected.told(),
        estimators=found.levels,
        note=found.note,
    )


def _verdict(found: Slope, limit: float) -> Verdict:
    if math.isnan(found.value):
        return Verdict.SKIPPED if found.finite else Verdict.FAIL
    if found.value + found.half_width(SHOWN) <= limit:
        return Verdict.PASS
    beyond = found.value - found.half_width(LEVEL) > limit
    return Verdict.FAIL if beyond else Verdict.INCONCLUSIVE
