"""The diagnosis of a refuted model: its cause, or the places where it fails; and what follows."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.diagnosis.cause import Examined
from montecarlo_brdf.diagnosis.laws import Law
from montecarlo_brdf.diagnosis.repair import Repair
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.diagnosis import Cause, Diagnosis, Part, Place
from montecarlo_brdf.judge.finding import Bound, Finding, Result, Verdict
from montecarlo_brdf.sampling.directions import Sampler

Refuted = list[tuple[Result, Finding]]
#: check -> the parts whose repair may mend it, the one that it is about first
BLAMED = {
    "positivity": (Part.VALUES,),
    "reciprocity": (Part.F, Part.VALUES),
    "isotropy": (Part.F, Part.VALUES),
    "energy": (Part.F, Part.VALUES),
    "equality": (Part.F, Part.VALUES),
    "limits": (Part.F, Part.VALUES),
    "furnace": (Part.F, Part.VALUES),
    "radiance": (Part.F, Part.VALUES),
    "pdf": (Part.PDF, Part.DRAWS, Part.VALUES),
    "sampling": (Part.PDF, Part.DRAWS),
    "cover": (Part.PDF, Part.WEIGHT, Part.DRAWS),
}
#: check -> the laws of f that must be seen to fail where it does, or no repair of f is believed
SEEN = {
    "reciprocity": {Law.RECIPROCITY}, "isotropy": {Law.ISOTROPY}, "equality": {Law.SAME},
    "energy": {Law.ENERGY, Law.REVERSE}, "limits": {Law.SAME, Law.ALBEDO},
}  # fmt: skip
#: part -> the function that is looked at
FUNCTIONS = {Part.VALUES: "f", Part.F: "f", Part.PDF: "pdf", Part.WEIGHT: "sample",
             Part.DRAWS: "sample"}  # fmt: skip
WEIGHTS, FAULTS = "|weight/(f cos/pdf) - 1|", "drawn directions at fault"


def refuted(results: Sequence[Result]) -> Refuted:
    """The findings that failed, of checks that a cause may explain."""
    return [
        (r, f) for r in results if r.check in BLAMED for f in r.findings
        if f.verdict == Verdict.FAIL
    ]  # fmt: skip


def blamed(check: str, f: Finding) -> tuple[Part, ...]:
    """The parts whose repair may mend a finding."""
    parts = BLAMED[check]
    if f.quantity == WEIGHTS:
        return (Part.WEIGHT, Part.PDF, Part.DRAWS, Part.VALUES)
    if f.quantity == FAULTS:
        return (Part.DRAWS, Part.PDF, Part.WEIGHT)
    if f.estimator == Sampler.OWN and parts[0] is Part.F and check != "energy":
        return (*parts, Part.PDF, Part.WEIGHT, Part.DRAWS)
    return parts


def diagnose(case: Case, results: Sequence[Result]) -> Diagnosis | None:
    """What is wrong with a model of one parameter set; None if nothing was refuted."""
    failed = refuted(results)
    if not failed:
        return None
    began = time.process_time()
    cause, first = _found(case, results, failed), failed[0][0]
    seconds = time.process_time() - began
    return Diagnosis(first.model, first.params, _place(failed, cause), cause, seconds)


def _found(case: Case, results: Sequence[Result], failed: Refuted) -> Cause | None:
    """The cause. Values that no formula expects, or sets that a model refuses, leave none: what was
    refuted is told all the same."""
    try:
        examined = Examined(case, results)
    except (UserError, ArithmeticError, ValueError):  # of NumPy's linear algebra, too
        return None
    return _cause(examined, _chosen(examined, failed))


def _chosen(examined: Examined, failed: Refuted) -> Repair | None:
    """The simplest repair that mends all that failed: at the places stored, and of the checks."""
    return examined.chosen(lambda r: all(_mended(examined, r, *one) for one in failed))


def _mended(examined: Examined, r: Repair, result: Result, f: Finding) -> bool:
    if not r.mends & set(blamed(result.check, f)):
        return False
    if r.part is Part.VALUES and result.check != "positivity":
        return not math.isfinite(f.value)
    seen = SEEN.get(result.check)
    of_f = r.part is Part.F and seen is not None
    return not of_f or bool(seen & set(examined.failed))  # type: ignore[operator]


def _place(failed: Refuted, cause: Cause | None) -> Place:
    """The worst finding of what is at fault: of the first part that fails, if no cause is known."""
    parts = (cause.part,) if cause else tuple(Part)
    for part in parts:
        some = [one for one in failed if blamed(one[0].check, one[1])[0] is part]
        if some:
            break
    else:
        some = failed
    checks = [*BLAMED]
    result, f = max(some, key=lambda one: (excess(one[1]), -checks.index(one[0].check)))
    function = FUNCTIONS[blamed(result.check, f)[0]]
    line = result.source.get("functions", {}).get(function)
    return Place(result.check, f, function, line)


def excess(f: Finding) -> float:
    """By how many tolerances a finding lies outside its bound."""
    if f.expected is None or not math.isfinite(f.value):
        return math.inf
    over = f.value - f.expected
    over = abs(over) if f.bound == Bound.EQUAL else -over if f.bound == Bound.AT_LEAST else over
    return over / (f.tolerance or 1e-12)


def _cause(examined: Examined, r: Repair | None) -> Cause | None:
    if r is None:
        return None
    n, laws = len(examined.at.spots), len(examined.failed)
    tested = (
        f"repaired, {'the law' if laws == 1 else f'the {laws} laws'} that failed "
        f"{'holds' if laws == 1 else 'hold'} at {n} of {n} places stored"
    )
    return Cause(r.part, r.sentence, tested)


def marked(results: Sequence[Result], found: Diagnosis) -> Iterator[Result]:
    """The results, with the findings marked that follow from the cause."""
    for r in results:
        yield replace(r, findings=[_marked(r.check, f, found.cause) for f in r.findings])


def _marked(check: str, f: Finding, cause: Cause | None) -> Finding:
    if cause is None or f.verdict != Verdict.FAIL or check not in BLAMED:
        return f
    about = blamed(check, f)[0]
    follows = about is not cause.part and not (about is Part.PDF and cause.part is Part.DRAWS)
    return replace(f, follows=cause.part) if follows else f
