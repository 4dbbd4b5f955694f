"""The judge: drives a claim until it is decided at its error level, or the samples run out.

Looks double (here: quadruple) the samples; look k may spend 2^-k of the level, so that looking
often does not raise the false-alarm rate. A refutation counts only when a fresh stream of another
point set with more replicates refutes it again.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf import student
from montecarlo_brdf.checks.claim import (
    Claim,
    ExactClaim,
    FitClaim,
    MeanClaim,
    Measurement,
    Reference,
    Skip,
)
from montecarlo_brdf.integration.estimators import Plan
from montecarlo_brdf.report.exact import exact_finding
from montecarlo_brdf.report.findings import Finding
from montecarlo_brdf.report.fit import fit_finding
from montecarlo_brdf.report.looks import FRESH, GROWTH, beyond, looks

LEVEL = 1e-9
CONFIRMING_REPLICATES = 64


class Opinion(NamedTuple):
    """What one estimator says of a claim at one look."""

    measurement: Measurement
    half_width: float
    verdict: str


def decide(claim: Claim, plan: Plan, known: str | None = None, level: float = LEVEL) -> Finding:
    """The finding for a claim; `known` is the reason if the model disclaims the property."""
    if isinstance(claim, Skip):
        return Finding(claim.quantity, {}, "skipped", note=claim.reason)
    if isinstance(claim, ExactClaim):
        return exact_finding(claim, known)
    if isinstance(claim, FitClaim):
        return fit_finding(claim, plan, known, level)
    return mean_finding(claim, plan, known, level)


def mean_finding(claim: MeanClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """Looks at growing sample sizes until every fit estimator has decided."""
    opinions: list[Opinion] = []
    spent = level
    for look, samples in enumerate(looks(plan.samples), start=1):
        spent = level * 2.0**-look
        measured = claim.measure(plan._replace(samples=samples))
        opinions = judged(claim, measured, spent)
        accused = {o.measurement.estimator for o in opinions if o.verdict == "fail"}
        if accused:
            if confirmed(claim, plan._replace(samples=samples), spent, accused):
                break
            opinions = [
                o._replace(verdict="inconclusive") if o.verdict == "fail" else o for o in opinions
            ]
        elif opinions and all(o.verdict == "pass" for o in opinions):
            break
    if claim.fallback and overall(opinions) == "inconclusive":
        opinions = judged(claim, [*measured, claim.fallback()], spent)
    return _finding(claim, opinions, spent, level, known)


def judged(claim: MeanClaim, measurements: list[Measurement], level: float) -> list[Opinion]:
    """Every estimator's opinion; the level is shared by those that are fit."""
    fit = [m for m in measurements if not m.unfit]
    each = level / max(1, len(fit))
    best = min(fit, key=lambda m: m.half_width(each), default=None)
    opinions = []
    for m in measurements:
        half = m.half_width(each)
        verdict = "unfit" if m.unfit else _verdict(claim, m, best, half, each)
        opinions.append(Opinion(m, half, verdict))
    if claim.expected is None and sum(o.verdict == "pass" for o in opinions) < 2:
        # one estimator alone agrees with itself
        opinions = [
            o._replace(verdict="inconclusive") if o.verdict == "pass" else o for o in opinions
        ]
    if claim.bound == "at most" and best is not None:
        opinions = [
            o if o.measurement is best or o.verdict == "fail" else _aside(o) for o in opinions
        ]
    return opinions


def _aside(opinion: Opinion) -> Opinion:
    """A bound is decided by the most precise estimator; the others only speak up to refute."""
    return opinion if opinion.verdict == "unfit" else opinion._replace(verdict="pass")


def _verdict(
    claim: MeanClaim, m: Measurement, best: Measurement | None, half: float, level: float
) -> str:
    value, expected = m.estimate.mean, claim.expected
    if not math.isfinite(value):
        return "fail"
    if expected is None:
        if best is None or m is best:
            return "pass"
        expected = Reference(best.estimate.mean, best.half_width(level), "", "")
    slack = half + expected.error
    over = value - expected.value
    if claim.bound == "at most":
        over = max(over, -math.inf)
        return "pass" if over + slack <= claim.tolerance else beyond(over, slack, claim.tolerance)
    if abs(over) + slack <= claim.tolerance:
        return "pass"
    return beyond(abs(over), slack, claim.tolerance)


def confirmed(claim: MeanClaim, plan: Plan, level: float, accused: set[str]) -> bool:
    """Whether one of the `accused` estimators refutes the claim again, on a fresh stream of another
    point set with more replicates."""
    fresh = plan._replace(
        points="independent" if plan.points != "independent" else "sobol",
        replicates=CONFIRMING_REPLICATES,
        samples=GROWTH * plan.samples,
        seed=plan.seed + FRESH,
    )
    again = judged(claim, claim.measure(fresh), level)
    return any(o.verdict == "fail" and o.measurement.estimator in accused for o in again)


def _hint(claim: MeanClaim, value: float) -> str | None:
    from montecarlo_brdf.checks.hints import hint  # imports numpy, which a pass does without

    return hint(claim, value)


def _finding(
    claim: MeanClaim, opinions: list[Opinion], spent: float, level: float, known: str | None
) -> Finding:
    telling = _telling(opinions)
    verdict = overall(opinions)
    if verdict == "fail" and known:
        verdict = "known"
    e = telling.measurement.estimate
    expected = claim.expected
    return Finding(
        quantity=claim.quantity,
        where=dict(claim.where),
        verdict=verdict,
        bound=claim.bound,
        value=e.mean,
        stderr=e.stderr,
        expected=expected.value if expected else None,
        tolerance=claim.tolerance,
        resolves=resolves(claim, telling.measurement, spent / max(1, len(opinions))),
        level=level,
        samples=e.samples,
        estimator=telling.measurement.estimator,
        reference={"kind": expected.kind, "source": expected.source, "error": expected.error}
        if expected
        else None,
        estimators=[_row(o) for o in opinions],
        note=known if verdict == "known" else _note(verdict, opinions) or e.method or None,
        hint=_hint(claim, e.mean) if verdict in ("fail", "known") else None,
        reproduce=claim.reproduce or None,
    )


def overall(opinions: list[Opinion]) -> str:
    """Refuted by any, else held by those that resolve the tolerance, else inconclusive."""
    verdicts = {o.verdict for o in opinions}
    if "fail" in verdicts:
        return "fail"
    return "pass" if "pass" in verdicts else "inconclusive"


def _telling(opinions: list[Opinion]) -> Opinion:
    """The opinion that a finding shows: one that refutes, else the most precise that decided.

    Samples come before a quadrature: its value is shown where they leave the claim open.
    """
    order = {"fail": 0, "pass": 1, "inconclusive": 2, "unfit": 3}

    def rank(o: Opinion) -> tuple[int, bool, float]:
        return order[o.verdict], o.measurement.bound is not None, o.half_width

    return min(opinions, key=rank)


def resolves(claim: MeanClaim, m: Measurement, level: float) -> float:
    """The deviation that a FAIL at this look would have caught with probability 95 %."""
    e = m.estimate
    if m.bound is not None:
        return claim.tolerance + m.bound
    if e.dof < 1:
        return math.inf
    tail = level if claim.bound == "at most" else level / 2.0
    power = student.quantile(0.05, e.dof)
    return claim.tolerance + (student.quantile(tail, e.dof) + power) * e.stderr


def _row(opinion: Opinion) -> dict[str, object]:
    m = opinion.measurement
    row: dict[str, object] = {
        "estimator": m.estimator,
        "value": m.estimate.mean,
        "stderr": m.estimate.stderr,
        "samples": m.estimate.samples,
        "verdict": opinion.verdict,
    }
    if m.unfit:
        row["not_used"] = m.unfit
    elif opinion.verdict == "inconclusive":
        row["not_used"] = (
            f"resolves only {opinion.half_width:.1e} with {m.estimate.samples} samples"
        )
    return row


def _note(verdict: str, opinions: list[Opinion]) -> str | None:
    """What an inconclusive finding needs."""
    if verdict != "inconclusive":
        return None
    reasons = [o.measurement.unfit for o in opinions if o.measurement.unfit]
    fit = [o for o in opinions if not o.measurement.unfit]
    if fit:
        return (
            f"undecided at {fit[0].measurement.estimate.samples} samples: allow more with --samples"
        )
    return reasons[0] if reasons else None
