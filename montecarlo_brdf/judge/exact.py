"""Judging deterministic claims: an error bound instead of an error rate."""
from __future__ import annotations

import math

from montecarlo_brdf.judge.claim import Exact, ExactClaim, Limit
from montecarlo_brdf.judge.finding import Finding, Verdict
from montecarlo_brdf.judge.looks import beyond, excess


def exact_finding(claim: ExactClaim, known: str | None) -> Finding:
    """A deterministic value against its bound."""
    found, expected = claim.evaluate(), claim.expected
    verdict, note = _exact_verdict(claim, found), found.note
    hint = found.hint if verdict == Verdict.FAIL else None
    if verdict == Verdict.FAIL and (found.example or known):
        verdict = Verdict.KNOWN if known else verdict
        note = "; ".join(filter(None, (found.example, known)))
    return Finding(
        claim.quantity,
        {**claim.where, **found.where},
        verdict,
        claim.bound,
        found.value,
        found.error,
        expected=expected.value,
        tolerance=claim.tolerance,
        samples=found.points,
        estimator=claim.estimator,
        reference=expected.told(),
        note=note,
        hint=hint,
        reproduce=found.reproduce if verdict != Verdict.PASS else None,
    )


def _exact_verdict(claim: ExactClaim, found: Exact) -> Verdict:
    if found.note and not found.points:
        return Verdict.INCONCLUSIVE
    if not math.isfinite(found.value):
        return Verdict.FAIL
    over = excess(claim.bound, found.value - claim.expected.value)
    slack = found.error + claim.expected.error
    if over + slack <= claim.tolerance:
        return Verdict.PASS
    return beyond(over, slack, claim.tolerance)


def limit_finding(claim: Limit) -> Finding:
    """A number that is told: nothing is promised, so nothing is refuted."""
    return Finding(
        claim.quantity,
        dict(claim.where),
        Verdict.PASS if claim.note is None else Verdict.KNOWN,
        value=claim.value,
        stderr=0.0,
        samples=claim.samples,
        estimator=claim.estimator,
        note=claim.note,
    )
