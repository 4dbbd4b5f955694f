"""Judging whether samples follow a density: surely close, or rejected twice, or undecided."""
from __future__ import annotations

import math

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import FitClaim
from montecarlo_brdf.judge.finding import Bound, Finding
from montecarlo_brdf.judge.looks import FRESH, looks


def fit_finding(claim: FitClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """Pass if the distance is surely small, fail if rejected twice on independent streams."""
    verdict, fit = "inconclusive", None
    for look, samples in enumerate(looks(plan.samples), start=1):
        spent = level * 2.0**-look
        sized = plan._replace(samples=samples)
        fit = claim.measure(sized, spent)
        if fit.note:
            break
        if fit.p_value < spent and fit.distance > claim.tolerance:
            again = claim.measure(sized._replace(seed=plan.seed + FRESH), spent)
            if again.p_value < spent:
                verdict = "known" if known else "fail"
                break
        if fit.upper <= claim.tolerance:
            verdict = "pass"
            break
    assert fit is not None
    return Finding(
        claim.quantity,
        dict(claim.where),
        verdict,
        Bound.AT_MOST,
        fit.distance,
        (fit.upper - fit.distance) if math.isfinite(fit.upper) else math.nan,
        expected=0.0,
        tolerance=claim.tolerance,
        resolves=claim.tolerance + fit.upper - fit.distance,
        level=level,
        samples=fit.samples,
        estimator="counts",
        note=known if verdict == "known" else fit.note,
        hint=fit.hint if verdict in ("fail", "known") else None,
        reproduce=(claim.reproduce or None) if verdict != "pass" else None,
    )
