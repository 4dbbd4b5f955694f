"""Judging deterministic claims: an error bound instead of an error rate."""
from __future__ import annotations

import math

from montecarlo_brdf.judge.claim import Exact, ExactClaim
from montecarlo_brdf.judge.finding import Finding
from montecarlo_brdf.judge.looks import beyond, excess


def exact_finding(claim: ExactClaim, known: str | None) -> Finding:
    """A deterministic value against its bound: no error rate, an error bound instead."""
    found = claim.evaluate()
    verdict = _exact_verdict(claim, found)
    expected = claim.expected
    return Finding(
        claim.quantity,
        {**claim.where, **found.where},
        "known" if verdict == "fail" and known else verdict,
        claim.bound,
        found.value,
        found.error,
        expected=expected.value,
        tolerance=claim.tolerance,
        samples=found.points,
        estimator="exact",
        reference={"kind": expected.kind, "source": expected.source, "error": expected.error},
        note=known if verdict == "fail" and known else found.note,
        hint=found.hint if verdict == "fail" else None,
        reproduce=(claim.reproduce or None) if verdict != "pass" else None,
    )


def _exact_verdict(claim: ExactClaim, found: Exact) -> str:
    if found.note and not found.points:
        return "inconclusive"
    if not math.isfinite(found.value):
        return "fail"
    over = excess(claim.bound, found.value - claim.expected.value)
    slack = found.error + claim.expected.error
    if over + slack <= claim.tolerance:
        return "pass"
    return beyond(over, slack, claim.tolerance)
