"""The judge: one finding for every claim, decided at its error level, or open in the end."""

from __future__ import annotations

import math

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Claim, ExactClaim, FitClaim, Limit, Skip, Slope, SlopeClaim
from montecarlo_brdf.judge.finding import Bound, Finding, Verdict
from montecarlo_brdf.judge.mean import FRESH, further, looks, mean_finding

LEVEL = 1e-9
SLOPE_LEVEL = 1e-6  # chance that a true claim about a slope is refuted
SHOWN = 0.05  # of a slope's interval, which is shown and must lie below the claim to hold it


def decide(claim: Claim, plan: Plan, known: str | None = None, level: float = LEVEL) -> Finding:
    """The finding for a claim; `known` is the reason if the model disclaims the property."""
    if isinstance(claim, Skip):
        return Finding(claim.quantity, {}, Verdict.SKIPPED, note=claim.reason)
    if isinstance(claim, ExactClaim):
        return _exact(claim, known)
    if isinstance(claim, FitClaim):
        return _fit(claim, plan, known, level)
    if isinstance(claim, SlopeClaim):
        return _slope(claim, plan)
    if isinstance(claim, Limit):
        return _limit(claim)
    return mean_finding(claim, plan, known, level)


def _exact(claim: ExactClaim, known: str | None) -> Finding:
    """A deterministic value against its bound: an error bound instead of an error rate."""
    found, expected = claim.evaluate(), claim.expected
    verdict = expected.verdict(claim.bound, found.value, found.error, claim.tolerance)
    note = found.note
    if note and not found.points:
        verdict = Verdict.INCONCLUSIVE
    hint = found.hint if verdict == Verdict.FAIL else None
    if verdict == Verdict.FAIL and (found.example or known):
        verdict = Verdict.KNOWN if known else verdict
        note = "; ".join(filter(None, (found.example, known)))
    return Finding(
        claim.quantity, {**claim.where, **found.where}, verdict, claim.bound,
        found.value, found.error, expected.value, claim.tolerance,
        samples=found.points, estimator=claim.estimator, reference=expected.told(),
        note=note, hint=hint, reproduce=found.reproduce if verdict != Verdict.PASS else None,
    )  # fmt: skip


def _limit(claim: Limit) -> Finding:
    """A number that is told: nothing is promised, so nothing is refuted."""
    verdict = Verdict.PASS if claim.note is None else Verdict.KNOWN
    return Finding(
        claim.quantity, dict(claim.where), verdict, value=claim.value, stderr=0.0,
        samples=claim.samples, estimator=claim.estimator, note=claim.note,
    )  # fmt: skip


def _fit(claim: FitClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """Pass if the distance is surely small, fail if rejected twice on independent streams."""
    verdict, taken = Verdict.INCONCLUSIVE, 0
    for look, samples in enumerate([*looks(plan.samples), *further(plan)], start=1):
        spent = level * 2.0**-look
        sized = plan._replace(samples=samples)
        fit = claim.measure(sized, spent)
        if fit.note or fit.samples == taken:  # it takes no more draws
            break
        taken = fit.samples
        if fit.p_value < spent and fit.distance > claim.tolerance:
            again = claim.measure(sized._replace(seed=plan.seed + FRESH), spent)
            if again.p_value < spent:
                verdict = Verdict.KNOWN if known else Verdict.FAIL
                break
        if fit.upper <= claim.tolerance:
            verdict = Verdict.PASS
            break
    refuted = verdict in (Verdict.FAIL, Verdict.KNOWN)
    return Finding(
        claim.quantity, dict(claim.where), verdict, Bound.AT_MOST,
        fit.distance, fit.upper - fit.distance if math.isfinite(fit.upper) else math.nan,
        0.0, claim.tolerance, claim.tolerance + fit.upper - fit.distance, level,
        fit.samples, "counts", note=known if verdict == Verdict.KNOWN else fit.note,
        hint=fit.hint if refuted else None, draws=dict(fit.draws) if fit.draws else None,
    )  # fmt: skip


def _slope(claim: SlopeClaim, plan: Plan) -> Finding:
    """Held if the shown interval lies below the claim, refuted if that of SLOPE_LEVEL lies above
    it."""
    found, expected = claim.measure(plan), claim.expected
    verdict, note = _slope_verdict(found, expected.value + claim.tolerance), found.note
    if verdict == Verdict.FAIL and found.doubt:
        verdict, note = Verdict.INCONCLUSIVE, found.doubt
    return Finding(
        claim.quantity, dict(claim.where), verdict, Bound.AT_MOST,
        found.value, found.stderr, expected.value, claim.tolerance,
        level=SLOPE_LEVEL, samples=found.samples, reference=expected.told(),
        estimators=found.levels, note=note,
    )  # fmt: skip


def _slope_verdict(found: Slope, limit: float) -> Verdict:
    if math.isnan(found.value):
        return Verdict.SKIPPED if found.finite else Verdict.FAIL
    if found.value + found.half_width(SHOWN) <= limit:
        return Verdict.PASS
    beyond = found.value - found.half_width(SLOPE_LEVEL) > limit
    return Verdict.FAIL if beyond else Verdict.INCONCLUSIVE
