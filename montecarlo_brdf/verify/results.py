"""From claims to results: the road that every question takes."""
from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.errors import TooSlow, UserError, unknown
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Claim
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Finding, Report, Result, Verdict
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify.supervision import Deadline, supervised

INTERRUPTED = "interrupted"  # of what a report measured: whether it was
PATIENCE = 20.0  # seconds for a few evaluations: sampling needs a million
Progress = Callable[[float], None]  # gets the fraction done
Sets: TypeAlias = "NamedTuple | list[Any] | None"  # one parameter set, several, the defaults
Repeat = Callable[[Finding], str | None]  # the command line that gives a finding again


class Question(NamedTuple):
    """What is asked of a case: claims under a name."""

    name: str
    case: Case
    claims: Callable[[Case], Iterable[Claim]]

    def result(self, findings: list[Finding]) -> Result:
        """The answer as a result."""
        model, p, _ = self.case[:3]
        return Result(
            model.name, shown_parameters(model, p), self.name, findings, source=source(model)
        )


def answered(
    questions: Sequence[Question], plan: Plan, count: int, progress: Progress | None = None
) -> list[Result]:
    """The results of questions, one after another; count: about how many claims each has."""
    results = []
    for k, question in enumerate(questions):
        case = question.case
        probed(case.model, case.p)
        part = part_of(progress, k, len(questions))
        claims = question.claims(case)
        found = decided(claims, plan, case.model.disclaims, count=count, progress=part)
        results.append(question.result(found))
    return results


def decided(
    claims: Iterable[Claim],
    plan: Plan,
    disclaims: Mapping[str, str],
    repeat: Repeat | None = None,
    *,
    count: int = 1,
    progress: Progress | None = None,
) -> list[Finding]:
    """The findings of all claims, in their order; count: about how many there are."""
    findings = []
    for claim in claims:
        findings.append(judged(claim, plan, disclaims, repeat))
        if progress:
            progress(min(1.0, len(findings) / count))
    return findings


def judged(
    claim: Claim, plan: Plan, disclaims: Mapping[str, str], repeat: Repeat | None = None
) -> Finding:
    """The finding of one claim, with the command that repeats it if it did not hold.

    disclaims: what is known not to hold, with the reason.
    """
    finding = decide(claim, plan, disclaims.get(claim.property or ""))
    if repeat and finding.verdict not in (Verdict.PASS, Verdict.SKIPPED):
        finding = replace(finding, reproduce=repeat(finding))
    return finding


def reported(
    command: str, settings: dict[str, Any], results: list[Result], started: float
) -> Report:
    """A finished report; how long it took lies outside `results`."""
    return Report(command, settings, results, {"seconds": time.perf_counter() - started})


def merged(reports: Sequence[Report]) -> Report:
    """One report of several; the settings are those of the first."""
    first = reports[0]
    measured = {"seconds": sum(r.measured["seconds"] for r in reports)}
    if INTERRUPTED in first.measured:
        measured[INTERRUPTED] = any(r.measured[INTERRUPTED] for r in reports)
    results = [result for r in reports for result in r.results]
    return Report(first.command, first.settings, results, measured)


def part_of(progress: Progress | None, k: int, n: int) -> Progress | None:
    """The progress of part k out of n as progress of the whole."""
    return (lambda done: progress((k + done) / n)) if progress else None


def parameter_sets(model: Model, p: Sets) -> list[Any]:
    """The sets that a caller means by one, a list of them, or None for the defaults."""
    return list(p) if isinstance(p, list) else [model.parameters() if p is None else p]


def shown_parameters(model: Model, p: NamedTuple) -> dict[str, Any]:
    """Parameters and choices by name, as reports print them."""
    return {**{model.labels.get(k, k): v for k, v in p._asdict().items()}, **model.picks}


def chosen(
    kind: str, asked: str | Sequence[str], offered: Sequence[str], known: Sequence[str] = ()
) -> list[str]:
    """The names asked for, all of them for "all"; UserError for one that is not offered.

    known: the names that exist, if more than are offered.
    """
    if asked == "all":
        return list(offered)
    names = [asked] if isinstance(asked, str) else list(asked)
    for name in names:
        if name not in offered:
            raise UserError(unknown(kind, name, ("all", *(known or offered))))
    return names


def probed(model: Model, p: NamedTuple) -> None:
    """A first look at the model, where it can be left; TooSlow if it does not return."""
    if not supervised(lambda: probe.check(model, p), Deadline(PATIENCE)):
        raise TooSlow(
            f"model {model.name} did not return from its first few evaluations in {PATIENCE:g} s: "
            "too slow to be sampled, or an endless loop"
        )


def source(model: Model) -> dict[str, Any]:
    """File and line of the f of a user's file, relative to here if it lies below."""
    code = getattr(getattr(model.f, "py_func", model.f), "__code__", None)
    if model.built_in or model.terms or code is None or not os.path.isfile(code.co_filename):
        return {}
    below = os.path.relpath(code.co_filename)
    outside = below.startswith("..")
    file = os.path.abspath(code.co_filename) if outside else below.replace(os.sep, "/")
    return {"file": file, "line": code.co_firstlineno}
