"""Judging means: looks at growing sample sizes until a claim is decided, a refutation confirmed.

Looks quadruple the samples; look k may spend 2^-k of the level, so that looking often does not
raise the false-alarm rate. A refutation counts only when fresh randomisations, more of them and
with more samples, refute it again.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from montecarlo_brdf.checks.claim import MeanClaim, Measurement
from montecarlo_brdf.integration.plan import Plan
from montecarlo_brdf.report.findings import Finding
from montecarlo_brdf.report.looks import FRESH, GROWTH, looks
from montecarlo_brdf.report.opinions import (
    Opinion,
    changed,
    judged,
    needed,
    overall,
    resolves,
    settled,
    telling,
)

CONFIRMING_REPLICATES = 64
#: As precise as the look, so that what it resolved can be confirmed, and independent of it, so that
#: the probabilities of both being wrong multiply. Lattices are not asked: where one mode dominates,
#: the tails of few shifts are not those of Student's t.
CONFIRMING_POINTS = "sobol"


def mean_finding(claim: MeanClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """The finding for a mean: looked at until every estimator that can has decided."""
    opinions: list[Opinion] = []
    for look, samples in enumerate(looks(plan.samples), start=1):
        spent = level * 2.0**-look
        sized = plan._replace(samples=samples)
        opinions = judged(claim, claim.measure(sized), spent)
        opinions = confirmed(claim, sized, spent, opinions)
        if overall(opinions) == "fail" or settled(claim, opinions, plan.samples):
            break
    if claim.fallback and overall(opinions) == "inconclusive":
        opinions += _asked_last(claim, claim.fallback, plan.seed, spent)
    return _finding(claim, opinions, level, (sized.samples, plan.samples), known)


def confirmed(claim: MeanClaim, plan: Plan, level: float, opinions: list[Opinion]) -> list[Opinion]:
    """The opinions, a refutation being inconclusive unless the same estimator refutes again, by
    fresh and more randomisations."""
    if overall(opinions) != "fail":
        return opinions
    fresh = plan._replace(
        points=CONFIRMING_POINTS,
        replicates=CONFIRMING_REPLICATES,
        samples=GROWTH * plan.samples,
        seed=plan.seed + FRESH,
    )
    again = judged(claim, claim.measure(fresh), level)
    sure = {o.measurement.estimator for o in again if o.verdict == "fail"}
    return changed(
        opinions,
        lambda o: o.verdict == "fail" and o.measurement.estimator not in sure,
        "inconclusive",
    )


def _asked_last(
    claim: MeanClaim, fallback: Callable[[int], Measurement], seed: int, level: float
) -> list[Opinion]:
    """What is asked where samples left the claim open; a refutation counts if repeated."""
    opinions = judged(claim, [fallback(seed)], level)
    if overall(opinions) == "fail":
        again = judged(claim, [fallback(seed + FRESH)], level)
        opinions = opinions if overall(again) == "fail" else again
    return opinions


def _finding(
    claim: MeanClaim,
    opinions: list[Opinion],
    level: float,
    looked: tuple[int, int],  # samples of the last look taken, and of the last one allowed
    known: str | None,
) -> Finding:
    shown, verdict = telling(opinions), overall(opinions)
    fit = sum(not o.measurement.unfit for o in opinions)
    last = level * 2.0 ** -len(looks(looked[1])) / max(1, fit)
    if verdict == "fail" and known:
        verdict = "known"
    e, expected = shown.measurement.estimate, claim.expected
    reference = expected._asdict() if expected else {}
    return Finding(
        quantity=claim.quantity,
        where=dict(claim.where),
        verdict=verdict,
        bound=claim.bound,
        value=e.mean,
        stderr=e.stderr,
        expected=reference.pop("value", None),
        tolerance=claim.tolerance,
        resolves=resolves(claim, shown, last, looked[0] / looked[1]),
        level=level,
        samples=e.samples,
        estimator=shown.measurement.estimator,
        reference={k: reference[k] for k in ("kind", "source", "error")} if expected else None,
        estimators=[_row(claim, o) for o in opinions],
        note=known if verdict == "known" else _note(claim, verdict, opinions) or e.method or None,
        hint=_hint(claim, e.mean, opinions) if verdict in ("fail", "known") else None,
        reproduce=claim.reproduce or None,
    )


def _hint(claim: MeanClaim, value: float, opinions: list[Opinion]) -> str | None:
    from montecarlo_brdf.checks.hints import hint  # imports numpy, which a pass does without

    found = [(o.measurement.estimator, o.measurement.estimate.mean) for o in opinions]
    # where only the model's own draws spoil the mean it is rather the pdf that they are divided by
    others = [v for name, v in found if name != "own"]
    return hint(claim, value, only_own=bool(others) and all(map(math.isfinite, others)))


def _row(claim: MeanClaim, opinion: Opinion) -> dict[str, object]:
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
            f"resolves only {opinion.half_width:.1e} with {m.estimate.samples} samples: "
            f"needs about {needed(claim, opinion):.0e}"
        )
    return row


def _note(claim: MeanClaim, verdict: str, opinions: list[Opinion]) -> str | None:
    """What an inconclusive finding needs."""
    if verdict != "inconclusive":
        return None
    reasons = [o.measurement.unfit for o in opinions if o.measurement.unfit]
    fit = [o for o in opinions if not o.measurement.unfit]
    if fit:
        need = min(needed(claim, o) for o in fit)
        samples = fit[0].measurement.estimate.samples
        return f"undecided at {samples} samples: needs about {need:.0e}, allow more with --samples"
    return reasons[0] if reasons else None
