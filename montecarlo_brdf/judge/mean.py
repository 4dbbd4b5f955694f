"""Judging means: looks at growing sample sizes until a claim is decided, a refutation confirmed.

Looks quadruple the samples; look k may spend 2^-k of the level, so that looking often does not
raise the false-alarm rate. A refutation counts only when fresh randomisations, more of them and
with more samples, refute it again.
"""

from __future__ import annotations

import math
from dataclasses import replace

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Kind, MeanClaim
from montecarlo_brdf.judge.finding import Finding, Verdict
from montecarlo_brdf.judge.hint import hint
from montecarlo_brdf.judge.looks import FRESH, GROWTH, looks
from montecarlo_brdf.judge.opinions import (
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
#: estimators that use nothing of a model but its f
OF_F_ALONE = ("uniform", "cosine")


def mean_finding(claim: MeanClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """The finding for a mean: looked at until every estimator that can has decided.

    Where a quadrature of f is refuted that says the same f, the estimators are held against each
    other: if they agree, it has missed something.
    """
    opinions, looked = _looked_at(claim, plan, level)
    if overall(opinions) == Verdict.FAIL and _of_same_f(claim):
        alone = replace(claim, expected=None)
        found, further = _looked_at(alone, plan, level)
        if _missed(opinions) or overall(found) == Verdict.PASS:
            claim, opinions, looked = alone, found, further
    return _finding(claim, opinions, level, (looked, plan.samples), known)


def _of_same_f(claim: MeanClaim) -> bool:
    """Whether the expected value is a quadrature of the f that is sampled."""
    return claim.expected is not None and claim.expected.kind == Kind.SAME_F


def _resolving(claim: MeanClaim, opinions: list[Opinion]) -> Opinion:
    """The opinion that says which deviation would be caught: the one shown, but where a quadrature
    says the same f that of the model's own draws, as others refute the quadrature."""
    own = [o for o in opinions if o.measurement.estimator not in OF_F_ALONE]
    drawn = [o for o in own if not o.measurement.unfit and o.measurement.bound is None]
    return telling(drawn if drawn and _of_same_f(claim) else opinions)


def _missed(opinions: list[Opinion]) -> bool:
    """Whether samples of f refute a quadrature of the same f: it has missed something."""
    refuting = [o.measurement for o in opinions if o.verdict == Verdict.FAIL]
    return any(m.estimator in OF_F_ALONE and math.isfinite(m.estimate.mean) for m in refuting)


def _looked_at(claim: MeanClaim, plan: Plan, level: float) -> tuple[list[Opinion], int]:
    """What all estimators say at last, and the samples of that look."""
    opinions: list[Opinion] = []
    for look, samples in enumerate(looks(plan.samples), start=1):
        spent = level * 2.0**-look
        sized = plan._replace(samples=samples)
        opinions = judged(claim, claim.measure(sized), spent)
        opinions = confirmed(claim, sized, spent, opinions)
        if overall(opinions) == Verdict.FAIL or settled(claim, opinions, plan.samples):
            break
    if claim.fallback and overall(opinions) == Verdict.INCONCLUSIVE:
        last = _asked_last if claim.expected else _compared_last
        opinions = last(claim, opinions, plan.seed, spent)
    return opinions, sized.samples


def confirmed(claim: MeanClaim, plan: Plan, level: float, opinions: list[Opinion]) -> list[Opinion]:
    """The opinions, a refutation being inconclusive unless the same estimator refutes again, by
    fresh and more randomisations."""
    if overall(opinions) != Verdict.FAIL:
        return opinions
    fresh = plan._replace(
        points=CONFIRMING_POINTS,
        replicates=CONFIRMING_REPLICATES,
        samples=GROWTH * plan.samples,
        seed=plan.seed + FRESH,
    )
    again = judged(claim, claim.measure(fresh), level)
    sure = {o.measurement.estimator for o in again if o.verdict == Verdict.FAIL}
    return changed(
        opinions,
        lambda o: o.verdict == Verdict.FAIL and o.measurement.estimator not in sure,
        Verdict.INCONCLUSIVE,
    )


def _asked_last(
    claim: MeanClaim, opinions: list[Opinion], seed: int, level: float
) -> list[Opinion]:
    """With what is asked where samples left the claim open; a refutation counts if repeated."""
    assert claim.fallback
    found = judged(claim, [claim.fallback(seed)], level)
    if overall(found) == Verdict.FAIL:
        again = judged(claim, [claim.fallback(seed + FRESH)], level)
        found = found if overall(again) == Verdict.FAIL else again
    return [*opinions, *found]


def _compared_last(
    claim: MeanClaim, opinions: list[Opinion], seed: int, level: float
) -> list[Opinion]:
    """The same where estimators are held against each other: the most precise one may have had
    none beside it. Two that agree hold the claim; two that do not leave it open."""
    assert claim.fallback
    last = claim.fallback(seed)
    fit = [o for o in opinions if not o.measurement.unfit]
    if not fit or last.unfit:
        return [*opinions, *judged(claim, [last], level)]
    best = min(fit, key=lambda o: o.half_width)
    pair = judged(claim, [best.measurement, last], level)
    if overall(pair) != Verdict.PASS:
        return opinions
    return [*(o for o in opinions if o is not best), *pair]


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
    if verdict == Verdict.FAIL and known:
        verdict = Verdict.KNOWN
    e, expected = shown.measurement.estimate, claim.expected
    note = known if verdict == Verdict.KNOWN else _note(claim, verdict, opinions) or e.method
    return Finding(
        quantity=claim.quantity,
        where=dict(claim.where),
        verdict=verdict,
        bound=claim.bound,
        value=e.mean,
        stderr=e.stderr,
        expected=expected.value if expected else None,
        tolerance=claim.tolerance,
        resolves=resolves(claim, _resolving(claim, opinions), last, looked[0] / looked[1]),
        level=level,
        samples=e.samples,
        estimator=shown.measurement.estimator,
        reference=expected.told() if expected else None,
        estimators=[_row(claim, o) for o in opinions],
        note=note or None,
        hint=_hint(claim, e.mean, opinions) if verdict in (Verdict.FAIL, Verdict.KNOWN) else None,
    )


def _hint(claim: MeanClaim, value: float, opinions: list[Opinion]) -> str | None:
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
    elif opinion.verdict == Verdict.INCONCLUSIVE:
        row["not_used"] = (
            f"resolves only {opinion.half_width:.1e} with {m.estimate.samples} samples: "
            f"needs about {_more(claim, opinion):.0e}"
        )
    return row


def _more(claim: MeanClaim, opinion: Opinion) -> float:
    """Samples that would decide: more than there were, where the interval alone was no obstacle."""
    return max(needed(claim, opinion), GROWTH * opinion.measurement.estimate.samples)


def _note(claim: MeanClaim, verdict: Verdict, opinions: list[Opinion]) -> str | None:
    """What an inconclusive finding needs."""
    if verdict != Verdict.INCONCLUSIVE:
        return None
    reasons = [o.measurement.unfit for o in opinions if o.measurement.unfit]
    fit = [o for o in opinions if not o.measurement.unfit]
    if fit:
        need = min(_more(claim, o) for o in fit)
        samples = fit[0].measurement.estimate.samples
        return f"undecided at {samples} samples: needs about {need:.0e}, allow more with --samples"
    return reasons[0] if reasons else None
