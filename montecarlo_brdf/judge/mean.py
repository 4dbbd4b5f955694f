"""Judging means: looks at growing sample sizes until a claim is decided, a refutation confirmed.

Looks quadruple the samples; look k may spend 2^-k of the level, so that looking often does not
raise the false-alarm rate. A refutation counts only when fresh randomisations, more of them and
with more samples, refute it again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import BLIND
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import Kind, MeanClaim, Reference
from montecarlo_brdf.judge.finding import Bound, Finding, Verdict
from montecarlo_brdf.judge.hint import hint
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import PointSet
from montecarlo_brdf.statistics import FLOOR, quantile

FIRST_LOOK = 1 << 14
GROWTH = 4
#: added to the seed for the fresh stream that must confirm a refutation
FRESH = 1 << 32
CONFIRMING_REPLICATES = 64
#: As precise as the look, so that what it resolved can be confirmed, and independent of it, so that
#: the probabilities of both being wrong multiply. Lattices are not asked: where one mode dominates,
#: the tails of few shifts are not those of Student's t.
CONFIRMING_POINTS = PointSet.SOBOL
#: estimators that use nothing of a model but its f: of directions from everywhere, or from a
#: sky, and another quadrature
OF_F_ALONE = (*BLIND, "sky", "quadrature")
#: how often a deviation of the size `resolves` may escape
ESCAPES = 0.05
#: how often the spread of another run may exceed what `resolves` allows for
LUCK = 5e-3
#: an error falls like samples^-FASTEST at best: that of good points for a narrow lobe
FASTEST = 1.0
#: standard errors that the truth is from an estimate at most, where that only saves work
SURE = 4.0
LONGEST = 40  # the power of 2 of the most samples that may be asked for
UNFIT = "unfit"  # what is shown of an estimator that is not to be believed


class Opinion(NamedTuple):
    """What one estimator says of a claim at one look."""

    measurement: Measurement
    half_width: float
    verdict: Verdict | None  # None: it is unfit


Opinions = list[Opinion]


def judged(claim: MeanClaim, measurements: list[Measurement], level: float) -> Opinions:
    """Every estimator's opinion; the level is shared by those that are fit."""
    fit = [m for m in measurements if not m.unfit]
    each = level / max(1, len(fit))
    best = min(fit, key=lambda m: m.half_width(each), default=None)
    opinions = [
        Opinion(m, m.half_width(each), None if m.unfit else _verdict(claim, m, best, each))
        for m in measurements
    ]
    if claim.of_f:
        opinions = [_contradicting(o) for o in opinions]
    if claim.expected is None and sum(o.verdict == Verdict.PASS for o in opinions) < 2:
        # one estimator alone agrees with itself
        opinions = changed(opinions, lambda o: o.verdict == Verdict.PASS, Verdict.INCONCLUSIVE)
    if claim.bound == Bound.AT_MOST and best is not None:
        # a bound is decided by the most precise estimator; the others only speak up to refute
        quiet = (None, Verdict.FAIL)
        opinions = changed(
            opinions, lambda o: o.measurement is not best and o.verdict not in quiet, Verdict.PASS
        )
    return opinions


def _contradicting(o: Opinion) -> Opinion:
    """The opinion, not to be believed where the model's own draws refute f: their weights are
    divided by a pdf that may not be theirs."""
    if o.verdict != Verdict.FAIL or o.measurement.estimator != Sampler.OWN:
        return o
    unfit = "draws by own sampling refute f, or their pdf: see `pdf`"
    useless = o.measurement._replace(unfit=unfit, needs=math.inf)
    return o._replace(verdict=None, measurement=useless)


def changed(opinions: Opinions, which: Callable[[Opinion], bool], to: Verdict) -> Opinions:
    """The opinions, with another verdict for some."""
    return [o._replace(verdict=to) if which(o) else o for o in opinions]


def _verdict(claim: MeanClaim, m: Measurement, best: Measurement | None, level: float) -> Verdict:
    value, expected = m.estimate.mean, claim.expected
    if expected is None:
        if best is None or m is best:
            return Verdict.PASS if math.isfinite(value) else Verdict.FAIL
        expected = Reference(best.estimate.mean, best.half_width(level), Kind.SAME_F, "")
    return expected.verdict(claim.bound, value, m.half_width(level), claim.tolerance)


def overall(opinions: Opinions) -> Verdict:
    """Refuted by any, else held by those that resolve the tolerance, else inconclusive."""
    verdicts = {o.verdict for o in opinions}
    if Verdict.FAIL in verdicts:
        return Verdict.FAIL
    return Verdict.PASS if Verdict.PASS in verdicts else Verdict.INCONCLUSIVE


def needed(claim: MeanClaim, opinion: Opinion, rate: float = 0.5) -> float:
    """Samples that would resolve the tolerance, the error falling like samples^-rate."""
    room = claim.tolerance - (claim.expected.error if claim.expected else 0.0)
    samples = opinion.measurement.estimate.samples
    return samples * (opinion.half_width / room) ** (1.0 / rate) if room > 0.0 else math.inf


def settled(claim: MeanClaim, opinions: Opinions, most: int) -> bool:
    """Whether sampling on, up to `most`, changes nothing: the claim is held, and no other
    estimator will resolve the tolerance, nor refute what it does not look like refuting."""
    return overall(opinions) == Verdict.PASS and all(
        o.verdict == Verdict.PASS or _hopeless(claim, o, most) for o in opinions
    )


def _hopeless(claim: MeanClaim, o: Opinion, most: int) -> bool:
    e, expected = o.measurement.estimate, claim.expected
    if o.verdict is None:
        return o.measurement.needs > most
    if expected is None or needed(claim, o, FASTEST) <= most:
        return False
    over = expected.excess(claim.bound, e.mean)
    in_the_end = o.half_width * math.sqrt(e.samples / most)
    return over + SURE * e.stderr <= claim.tolerance + expected.error + in_the_end


def telling(opinions: Opinions) -> Opinion:
    """The opinion that a finding shows: one that refutes, else the most precise that decided.

    Samples come before a quadrature: its value is shown where they leave the claim open.
    """
    order = {Verdict.FAIL: 0, Verdict.PASS: 1, Verdict.INCONCLUSIVE: 2, None: 3}

    def rank(o: Opinion) -> tuple[int, bool, float]:
        return order[o.verdict], o.measurement.bound is not None, o.half_width

    return min(opinions, key=rank)


def resolves(claim: MeanClaim, opinion: Opinion, level: float, share: float) -> float:
    """The deviation that a run like this fails with probability 95 % at least.

    Nothing that deviates by more than the tolerance passes at any look, so the last one decides:
    with `level` for this estimator, and with an error that is smaller at least like samples^-1/2,
    down to rounding; this look took a `share` of its samples. Another seed has another spread, and
    this one may be small by chance. So the ratio of two spreads counts, the root of an
    F(dof, dof), whose quantiles are those of Student's t: Cacoullos 1965, "A relation between t
    and F-distributions", t = sinh(log(ratio)) sqrt(dof).
    """
    e = opinion.measurement.estimate
    known = claim.tolerance + (claim.expected.error if claim.expected else 0.0)
    if opinion.measurement.bound is not None:
        return known + opinion.half_width
    if e.dof < 1:
        return math.inf
    wider = math.exp(math.asinh(quantile(LUCK, e.dof) / math.sqrt(e.dof)))
    last = max(e.stderr * math.sqrt(share), FLOOR * abs(e.mean))
    widths = quantile(level / 2.0, e.dof) + quantile(ESCAPES, e.dof)
    return known + wider * widths * last


def looks(most: int) -> list[int]:
    """Sample sizes of the looks, the last one being all that is allowed."""
    sizes = []
    size = min(FIRST_LOOK, most)
    while size < most:
        sizes.append(size)
        size *= GROWTH
    return [*sizes, most]


def further(plan: Plan) -> list[int]:
    """Sample sizes of the looks beyond those allowed, where these leave a claim open that more are
    known to decide."""
    sizes, size = [], plan.samples * GROWTH
    while size <= plan.reach:
        sizes.append(size)
        size *= GROWTH
    return sizes


def mean_finding(claim: MeanClaim, plan: Plan, known: str | None, level: float) -> Finding:
    """The finding for a mean: looked at until every estimator that can has decided.

    Where a quadrature of f is refuted that says the same f, the estimators are held against each
    other: if they agree, it has missed something. It refutes what they say of the same integral
    only if another quadrature does so too; else nobody knows which of the two is wrong.
    """
    opinions, looked = _looked_at(claim, plan, level)
    if overall(opinions) != Verdict.FAIL or not _of_same_f(claim):
        return _finding(claim, opinions, level, (looked, max(looked, plan.samples)), known)
    found, again = _looked_at(replace(claim, expected=None), plan, level)
    if overall(found) == Verdict.PASS or (_missed(opinions) and overall(found) == Verdict.FAIL):
        return _finding(
            replace(claim, expected=None), found, level, (again, max(again, plan.samples)), known
        )
    told = None
    if _missed(opinions) or not _again(claim, opinions, plan, level):
        told = _unresolved(claim, opinions)
        opinions = changed(opinions, lambda o: o.verdict == Verdict.FAIL, Verdict.INCONCLUSIVE)
    return _finding(claim, opinions, level, (looked, max(looked, plan.samples)), known, told)


def _again(claim: MeanClaim, opinions: Opinions, plan: Plan, level: float) -> bool:
    """Whether another quadrature refutes what was measured, too: where the mean is no number none
    needs to."""
    if claim.afresh is None:
        return True
    other = claim.afresh(plan.seed + FRESH)
    measured = [o.measurement for o in opinions]
    lost = [m for m in measured if not m.unfit and not math.isfinite(m.estimate.mean)]
    if other is None:
        return bool(lost)
    return overall(judged(replace(claim, expected=other), measured, level)) == Verdict.FAIL


def _unresolved(claim: MeanClaim, opinions: Opinions) -> str:
    """That the tool's own numbers of one integral differ."""
    assert claim.expected
    o, expected = telling(opinions), claim.expected
    e = o.measurement.estimate
    return (
        f"not resolved: {o.measurement.estimator} sampling says {e.mean:.8g} +- "
        f"{o.half_width:.1e}, the quadrature of the same f {expected.value:.8g} +- "
        f"{expected.error:.1e}; decide it with --samples {GROWTH * e.samples}"
    )


def _of_same_f(claim: MeanClaim) -> bool:
    """Whether the expected value is a quadrature of the f that is sampled."""
    return claim.expected is not None and claim.expected.kind == Kind.SAME_F


def _resolving(claim: MeanClaim, opinions: Opinions) -> Opinion:
    """The opinion that says which deviation would be caught: the one shown, but where a quadrature
    says the same f that of the model's own draws, as others refute the quadrature."""
    own = [o for o in opinions if o.measurement.estimator not in BLIND]
    drawn = [o for o in own if not o.measurement.unfit and o.measurement.bound is None]
    return telling(drawn if drawn and _of_same_f(claim) else opinions)


def _missed(opinions: Opinions) -> bool:
    """Whether samples of f refute a quadrature of the same f: it has missed something."""
    refuting = [o.measurement for o in opinions if o.verdict == Verdict.FAIL]
    return any(m.estimator in OF_F_ALONE and math.isfinite(m.estimate.mean) for m in refuting)


def _looked_at(claim: MeanClaim, plan: Plan, level: float) -> tuple[Opinions, int]:
    """What all estimators say at last, and the samples of that look."""
    allowed, opinions = looks(plan.samples), list[Opinion]()
    for look, samples in enumerate(allowed, start=1):
        opinions = _at_look(claim, plan, level, look, samples)
        if overall(opinions) == Verdict.FAIL or settled(claim, opinions, plan.samples):
            break
    if claim.fallback and overall(opinions) == Verdict.INCONCLUSIVE:
        last = _asked_last if claim.expected else _compared_last
        opinions = last(claim, opinions, plan.seed, level * 2.0**-look)
    for look, samples in enumerate(further(plan), start=1 + len(allowed)):
        if overall(opinions) != Verdict.INCONCLUSIVE or not _within(claim, opinions, plan):
            break
        opinions = _at_look(claim, plan, level, look, samples)
    return opinions, samples


def _at_look(claim: MeanClaim, plan: Plan, level: float, look: int, samples: int) -> Opinions:
    """What all estimators say at one look."""
    spent, sized = level * 2.0**-look, plan._replace(samples=samples)
    return confirmed(claim, sized, spent, judged(claim, claim.measure(sized), spent))


def _within(claim: MeanClaim, opinions: Opinions, plan: Plan) -> bool:
    """Whether the samples within reach may decide what is open, errors falling as they do at best:
    two estimators that are held against each other must do so together. Those that took fewer than
    they may would take no more."""
    growing = [o for o in opinions if o.measurement.estimate.samples >= plan.samples]
    needs = sorted(
        o.measurement.needs or math.inf if o.verdict is None else needed(claim, o, FASTEST)
        for o in growing
    )
    both = 1 if claim.expected else 2
    return len(needs) >= both and both * needs[both - 1] <= plan.reach


def confirmed(claim: MeanClaim, plan: Plan, level: float, opinions: Opinions) -> Opinions:
    """The opinions, a refutation being inconclusive unless the same estimator refutes again, by
    fresh and more randomisations."""
    if overall(opinions) != Verdict.FAIL:
        return opinions
    fresh = plan._replace(
        points=CONFIRMING_POINTS, replicates=CONFIRMING_REPLICATES, samples=GROWTH * plan.samples,
        seed=plan.seed + FRESH,
    )  # fmt: skip
    again = judged(claim, claim.measure(fresh), level)
    sure = {o.measurement.estimator for o in again if o.verdict == Verdict.FAIL}
    return changed(
        opinions,
        lambda o: o.verdict == Verdict.FAIL and o.measurement.estimator not in sure,
        Verdict.INCONCLUSIVE,
    )


def _asked_last(claim: MeanClaim, opinions: Opinions, seed: int, level: float) -> Opinions:
    """With what is asked where samples left the claim open; a refutation counts if repeated."""
    assert claim.fallback
    found = judged(claim, [claim.fallback(seed)], level)
    if overall(found) == Verdict.FAIL:
        again = judged(claim, [claim.fallback(seed + FRESH)], level)
        found = found if overall(again) == Verdict.FAIL else again
    return [*opinions, *found]


def _compared_last(claim: MeanClaim, opinions: Opinions, seed: int, level: float) -> Opinions:
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
    claim: MeanClaim, opinions: Opinions, level: float, looked: tuple[int, int], known: str | None,
    doubt: str | None = None,
) -> Finding:  # fmt: skip
    """looked: samples of the last look taken, and of the last one allowed; doubt: why it is open,
    where that is known."""
    shown, verdict = telling(opinions), overall(opinions)
    fit = sum(not o.measurement.unfit for o in opinions)
    last = level * 2.0 ** -len(looks(looked[1])) / max(1, fit)
    if verdict == Verdict.FAIL and known:
        verdict = Verdict.KNOWN
    e, expected = shown.measurement.estimate, claim.expected
    note = known if verdict == Verdict.KNOWN else _note(claim, verdict, opinions, level) or e.method
    return Finding(
        claim.quantity, dict(claim.where), verdict, claim.bound, e.mean, e.stderr,
        expected.value if expected else None, claim.tolerance,
        resolves(claim, _resolving(claim, opinions), last, looked[0] / looked[1]), level,
        e.samples, shown.measurement.estimator, expected.told() if expected else None,
        [_row(claim, o) for o in opinions], doubt or note or None,
        _hint(claim, e.mean, opinions) if verdict in (Verdict.FAIL, Verdict.KNOWN) else None,
    )  # fmt: skip


def _hint(claim: MeanClaim, value: float, opinions: Opinions) -> str | None:
    found = [(o.measurement.estimator, o.measurement.estimate.mean) for o in opinions]
    # where only the model's own draws spoil the mean it is rather the pdf that they are divided by
    others = [v for name, v in found if name != Sampler.OWN]
    return hint(claim, value, only_own=bool(others) and all(map(math.isfinite, others)))


def _row(claim: MeanClaim, opinion: Opinion) -> dict[str, object]:
    m = opinion.measurement
    row: dict[str, object] = {
        "estimator": m.estimator, "value": m.estimate.mean, "stderr": m.estimate.stderr,
        "samples": m.estimate.samples, "verdict": opinion.verdict or UNFIT,
    }  # fmt: skip
    if m.unfit:
        row["not_used"] = m.unfit
    elif opinion.verdict == Verdict.INCONCLUSIVE and math.isinf(opinion.half_width):
        row["not_used"] = "so few samples show no error"
    elif opinion.verdict == Verdict.INCONCLUSIVE and m.bound is not None:
        row["not_used"] = f"resolves only {opinion.half_width:.1e}"
    elif opinion.verdict == Verdict.INCONCLUSIVE:
        row["not_used"] = (
            f"resolves only {opinion.half_width:.1e} with {m.estimate.samples} samples: "
            f"{_needs(claim, opinion)}"
        )
    return row


def _more(claim: MeanClaim, opinion: Opinion) -> float:
    """Samples that would decide: more than there were, where the interval alone was no obstacle."""
    return max(needed(claim, opinion), GROWTH * opinion.measurement.estimate.samples)


def _needs(claim: MeanClaim, opinion: Opinion) -> str:
    """'needs about 4e+06', or that no number helps."""
    more = _more(claim, opinion)
    return f"needs about {more:.0e}" if math.isfinite(more) else "more of them would not tell"


def _enough(claim: MeanClaim, opinion: Opinion, level: float) -> int:
    """The power of 2 of samples that decide, at the level that is left for their look."""
    m, room = opinion.measurement, claim.tolerance
    e, over = m.estimate, 0.0
    if claim.expected:
        room -= claim.expected.error
        over = max(0.0, claim.expected.excess(claim.bound, e.mean))
    power = math.ceil(math.log2(_more(claim, opinion)))
    while power < LONGEST:
        spent = level * 2.0 ** -len(looks(1 << power))
        if (m.half_width(spent) + over) * math.sqrt(e.samples / 2.0**power) <= room:
            break
        power += 1
    return power


def _note(claim: MeanClaim, verdict: Verdict, opinions: Opinions, level: float) -> str | None:
    """What an inconclusive finding needs."""
    if verdict != Verdict.INCONCLUSIVE:
        return None
    fit = [o for o in opinions if not o.measurement.unfit and o.measurement.bound is None]
    if fit:
        best = min(fit, key=lambda o: _more(claim, o))
        told = f"undecided at {fit[0].measurement.estimate.samples} samples"
        if math.isinf(best.half_width):
            return f"{told}, which show no error: allow more with --samples"
        if math.isinf(_more(claim, best)):
            return f"{told}: the reference is no more exact than the tolerance, or nothing varied"
        enough = _enough(claim, best, level / len(fit))
        return f"{told}: {_needs(claim, best)}, allow them by --samples 2^{enough}"
    return opinions[0].measurement.unfit if opinions else None
