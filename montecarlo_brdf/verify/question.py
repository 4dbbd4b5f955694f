"""A question: how closely to look, and the road from its claims to results that all take."""
from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.errors import ModelError, TooSlow, UserError, unknown
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.plan import (
    Choice,
    Plan,
    Progress,
    check_method,
    check_points,
    check_samples,
)
from montecarlo_brdf.judge.claim import Claim
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify import failure
from montecarlo_brdf.verify.supervision import Deadline, supervised

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

SAMPLES = 1 << 22
INTERRUPTED = "interrupted"  # of what a report measured: whether it was
PATIENCE = 20.0  # seconds for a few evaluations: sampling needs a million
Sets: TypeAlias = "NamedTuple | list[Any] | None"  # one parameter set, several, the defaults
#: is told of the findings of a check so far, and whether these are all
Heard = Callable[[Result, bool], None]
Repeat = Callable[[Finding], str | None]  # the command line that gives a finding again


class Settings(NamedTuple):
    """Everything that a question takes besides its subject and its places."""

    plan: Plan
    tolerance: float | None  # None: each claim's own

    @classmethod
    def of(
        cls, points: str = "sobol", samples: int = SAMPLES, seed: int = 0,
        threads: int | None = None, tolerance: float | None = None,
        target_error: float | None = None, method: str | None = None,
        sums: PartialSums | None = None, effort: float = 1.0, reach: int = 0,
    ) -> Settings:  # fmt: skip
        """As a caller says it. Raises UserError for a value that is not allowed."""
        named = check_points(points)
        if threads is not None and not (isinstance(threads, int) and 1 <= threads <= 1024):
            raise UserError(f"threads must be a whole number from 1 to 1024, not {threads}")
        if not isinstance(seed, int) or not 0 <= seed < 1 << 64:
            raise UserError(f"seed must be a whole number from 0 to 2^64 - 1, not {seed}")
        check_samples(samples)
        choice = check_method(method, target_error)
        if tolerance is not None and not 0.0 <= tolerance < 1.0:
            raise UserError(f"tolerance must be a number in [0, 1), not {tolerance}")
        number = isinstance(effort, int | float) and not isinstance(effort, bool)
        if not (number and 0.0 < effort <= 1.0):
            raise UserError(f"effort must be a number in (0, 1], not {effort}")
        plan = Plan(
            named, samples, seed=seed, threads=threads or all_threads(),
            target_error=target_error, method=choice, sums=sums, effort=effort, reach=reach,
        )  # fmt: skip
        return cls(plan, tolerance)

    def told(self) -> dict[str, Any]:
        """What results depend on, for a report; the number of threads is not among it."""
        plan = self.plan
        told: dict[str, Any] = {"points": plan.points, "samples": plan.samples, "seed": plan.seed}
        if plan.effort != 1.0:
            told["effort"] = plan.effort
        if plan.target_error is not None or plan.method is not Choice.GIVEN:
            told |= {"target_error": plan.target_error, "method": plan.method}
        return told

    def options(self, samples: int = SAMPLES) -> list[str]:
        """What of points, samples, seed and effort a command line must say: no default."""
        plan, default = self.plan, Plan(samples=samples)
        names = ("points", "samples", "seed", "effort")
        said = {n: getattr(plan, n) for n in names if getattr(plan, n) != getattr(default, n)}
        return [word for name, value in said.items() for word in (f"--{name}", str(value))]

    def tolerance_option(self) -> list[str]:
        """The same for the tolerance."""
        return [] if self.tolerance is None else ["--tolerance", exactly(self.tolerance)]


def all_threads() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def exactly(value: float) -> str:
    """A number with all its digits, and no more."""
    return f"{value:g}" if float(f"{value:g}") == value else repr(float(value))


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
    command: Command, told: dict[str, Any], questions: Sequence[Question], plan: Plan, count: int,
    progress: Progress | None = None, heard: Heard | None = None,
) -> Report:  # fmt: skip
    """The report of questions, one after another; count: about how many claims each has."""
    started, results, times = time.perf_counter(), [], []
    for k, question in enumerate(questions):
        case = question.case
        probed(case.model, case.p)
        part = part_of(progress, k, len(questions))
        claims, began = question.claims(case), time.perf_counter()
        tell = heard and _of_result(question, heard)
        with failure.of_case(case):
            found = decided(
                claims, plan, case.model.disclaims, count=count, progress=part, heard=tell
            )
        results.append(question.result(found))
        times.append(time.perf_counter() - began)
    return reported(command, told, results, started, times)


def decided(
    claims: Iterable[Claim], plan: Plan, disclaims: Mapping[str, str], repeat: Repeat | None = None,
    *, count: int = 1, progress: Progress | None = None,
    heard: Callable[[list[Finding], bool], None] | None = None,
) -> list[Finding]:  # fmt: skip
    """The findings of all claims, in their order; count: about how many there are."""
    findings = []
    for claim in claims:
        findings.append(judged(claim, plan, disclaims, repeat))
        if heard:
            heard(findings, False)
        if progress:
            progress(min(1.0, len(findings) / count))
    if heard:
        heard(findings, True)
    return findings


def _of_result(question: Question, heard: Heard) -> Callable[[list[Finding], bool], None]:
    return lambda findings, done: heard(question.result([*findings]), done)


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
    command: Command, settings: dict[str, Any], results: list[Result], started: float,
    times: Sequence[float] = (),
) -> Report:  # fmt: skip
    """A finished report; how long it, and each result, took lies outside `results`."""
    measured: dict[str, Any] = {"seconds": time.perf_counter() - started}
    measured |= {"seconds_of_results": list(times)} if times else {}
    return Report(command, settings, results, measured)


def merged(reports: Sequence[Report]) -> Report:
    """One report of several; the settings are those of the first that has some."""
    first = next((r for r in reports if r.settings), reports[0])
    measured: dict[str, Any] = {"seconds": sum(r.measured["seconds"] for r in reports)}
    if INTERRUPTED in first.measured:
        measured[INTERRUPTED] = any(r.measured.get(INTERRUPTED) for r in reports)
    times = [t for r in reports for t in r.measured.get("seconds_of_results", [])]
    results = [result for r in reports for result in r.results]
    if len(times) == len(results):
        measured["seconds_of_results"] = times
    told = [d for r in reports for d in r.diagnosis]
    return Report(first.command, first.settings, results, measured, diagnosis=told)


def failed(command: Command, model: str, error: ModelError) -> Report:
    """The report on a model that does not run, among others that do."""
    told = Finding(command, {}, Verdict.ERROR, note=str(error))
    measured = {"seconds": 0.0, INTERRUPTED: False}
    return Report(command, {}, [Result(model, {}, command, [told])], measured)


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
    if "all" in names:
        raise UserError(f"'all' stands alone, for every {kind}: leave out the other names")
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
    """File of a user's model, relative to here if it lies below, and the lines of its functions;
    `line` is that of f."""
    code = getattr(getattr(model.f, "py_func", model.f), "__code__", None)
    if model.built_in or model.terms or code is None or not os.path.isfile(code.co_filename):
        return {}
    below = os.path.relpath(code.co_filename)
    outside = below.startswith("..")
    file = os.path.abspath(code.co_filename) if outside else below.replace(os.sep, "/")
    found = {name: getattr(model, name) for name in ("f", "sample", "pdf", "prepare")}
    lines = {name: _line(function, code.co_filename) for name, function in found.items()}
    told = {name: line for name, line in lines.items() if line}
    return {"file": file, "line": code.co_firstlineno, "functions": told}


def _line(function: Any, file: str) -> int | None:
    """The line of a function, if it stands in a file."""
    code = getattr(getattr(function, "py_func", function), "__code__", None)
    return code.co_firstlineno if code is not None and code.co_filename == file else None
