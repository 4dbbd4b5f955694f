"""The judge: one finding for every claim, decided at its error level, or open in the end."""

from __future__ import annotations

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Claim, ExactClaim, FitClaim, Limit, Skip, SlopeClaim
from montecarlo_brdf.judge.exact import exact_finding, limit_finding
from montecarlo_brdf.judge.finding import Finding, Verdict
from montecarlo_brdf.judge.fit import fit_finding
from montecarlo_brdf.judge.mean import mean_finding
from montecarlo_brdf.judge.slope import slope_finding

LEVEL = 1e-9


def decide(claim: Claim, plan: Plan, known: str | None = None, level: float = LEVEL) -> Finding:
    """The finding for a claim; `known` is the reason if the model disclaims the property."""
    if isinstance(claim, Skip):
        return Finding(claim.quantity, {}, Verdict.SKIPPED, note=claim.reason)
    if isinstance(claim, ExactClaim):
        return exact_finding(claim, known)
    if isinstance(claim, FitClaim):
        return fit_finding(claim, plan, known, level)
    if isinstance(claim, SlopeClaim):
        return slope_finding(claim, plan)
    if isinstance(claim, Limit):
        return limit_finding(claim)
    return mean_finding(claim, plan, known, level)
