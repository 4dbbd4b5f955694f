"""What every estimator says of a mean at one look, and what that makes together."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from montecarlo_brdf import student
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import Kind, MeanClaim, Reference
from montecarlo_brdf.judge.finding import Bound, Verdict
from montecarlo_brdf.judge.looks import beyond, excess
from montecarlo_brdf.statistics import FLOOR

#: how often a deviation of the size `resolves` may escape
ESCAPES = 0.05
#: how often the spread of another run may exceed what `resolves` allows for
LUCK = 5e-3
#: an error falls like samples^-FASTEST at best: that of good points for a narrow lobe
FASTEST = 1.0
#: standard errors that the truth is from an estimate at most, where that only saves work
SURE = 4.0
UNFIT = "unfit"  # instead of a verdict, of an estimator that is not to be believed


class Opinion(NamedTuple):
    """What one estimator says of a claim at one look."""

    measurement: Measurement
    half_width: float
    verdict: str  # a Verdict or UNFIT


def judged(claim: MeanClaim, measurements: list[Measurement], level: float) -> list[Opinion]:
    """Every estimator's opinion; the level is shared by those that are fit."""
    fit = [m for m in measurements if not m.unfit]
    each = level / max(1, len(fit))
    best = min(fit, key=lambda m: m.half_width(each), default=None)
    opinions = []
    for m in measurements:
        half = m.half_width(each)
        verdict = UNFIT if m.unfit else _verdict(claim, m, best, half, each)
        opinions.append(Opinion(m, half, verdict))
    if claim.expected is None and sum(o.verdict == Verdict.PASS for o in opinions) < 2:
        # one estimator alone agrees with itself
        opinions = changed(opinions, lambda o: o.verdict == Verdict.PASS, Verdict.INCONCLUSIVE)
    if claim.bound == Bound.AT_MOST and best is not None:
        # a bound is decided by the most precise estimator; the others only speak up to refute
        quiet = (UNFIT, Verdict.FAIL)
        opinions = changed(
            opinions, lambda o: o.measurement is not best and o.verdict not in quiet, Verdict.PASS
        )
    return opinions


def changed(
    opinions: list[Opinion], which: Callable[[Opinion], bool], to: Verdict
) -> list[Opinion]:
    """The opinions, with another verdict for some."""
    return [o._replace(verdict=to) if which(o) else o for o in opinions]


def _verdict(
    claim: MeanClaim, m: Measurement, best: Measurement | None, half: float, level: float
) -> Verdict:
    value, expected = m.estimate.mean, claim.expected
    if not math.isfinite(value):
        return Verdict.FAIL
    if expected is None:
        if best is None or m is best:
            return Verdict.PASS
        expected = Reference(best.estimate.mean, best.half_width(level), Kind.SAME_F, "")
    slack = half + expected.error
    over = excess(claim.bound, value - expected.value)
    held = over + slack <= claim.tolerance
    return Verdict.PASS if held else beyond(over, slack, claim.tolerance)


def overall(opinions: list[Opinion]) -> Verdict:
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


def settled(claim: MeanClaim, opinions: list[Opinion], most: int) -> bool:
    """Whether sampling on, up to `most`, changes nothing: the claim is held, and no other
    estimator will resolve the tolerance, nor refute what it does not look like refuting."""
    return overall(opinions) == Verdict.PASS and all(
        o.verdict == Verdict.PASS or _hopeless(claim, o, most) for o in opinions
    )


def _hopeless(claim: MeanClaim, o: Opinion, most: int) -> bool:
    e, expected = o.measurement.estimate, claim.expected
    if o.verdict == UNFIT:
        return o.measurement.needs > most
    if expected is None or needed(claim, o, FASTEST) <= most:
        return False
    over = excess(claim.bound, e.mean - expected.value)
    in_the_end = o.half_width * math.sqrt(e.samples / most)
    return over + SURE * e.stderr <= claim.tolerance + expected.error + in_the_end


def telling(opinions: list[Opinion]) -> Opinion:
    """The opinion that a finding shows: one that refutes, else the most precise that decided.

    Samples come before a quadrature: its value is shown where they leave the claim open.
    """
    order = {Verdict.FAIL: 0, Verdict.PASS: 1, Verdict.INCONCLUSIVE: 2, UNFIT: 3}

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
    wider = math.exp(math.asinh(student.quantile(LUCK, e.dof) / math.sqrt(e.dof)))
    last = max(e.stderr * math.sqrt(share), FLOOR * abs(e.mean))
    widths = student.quantile(level / 2.0, e.dof) + student.quantile(ESCAPES, e.dof)
    return known + wider * widths * last
