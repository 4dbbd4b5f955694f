"""All checks of a model, in time, interruptible, each finding with a command that repeats it.

The checks of a case run side by side where they can be left (verify.supervision); what they left
undone is inconclusive, never forgotten.
"""
from __future__ import annotations

import functools
import shlex
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from montecarlo_brdf import checks
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.errors import ModelError, TooSlow
from montecarlo_brdf.estimate.plan import Plan, Progress, check_theta
from montecarlo_brdf.judge.diagnosis import Diagnosis, Place
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.model import Model, Property
from montecarlo_brdf.verify import failure
from montecarlo_brdf.verify.question import (
    Heard,
    Question,
    Sets,
    Settings,
    chosen,
    exactly,
    judged,
    parameter_sets,
    probed,
    reported,
    shown_parameters,
)
from montecarlo_brdf.verify.supervision import Deadline, supervised

ANGLES = (0.0, 45.0, 80.0)
SAMPLES = 1 << 20
REACH = 1 << 24  # of a claim that these leave open, where it is known that so many decide it
GRACE = 1.0  # seconds that a claim may go on after --max-time
#: what holds or does not, whatever is allowed of values
LAWS = (Property.RECIPROCITY, Property.ISOTROPY, Property.POSITIVITY)
MOST = 4  # tasks at once: what they do between kernels shares one interpreter


def run(
    model: Model, p: Sets = None, *, names: Sequence[str] | None = None,
    theta_o_deg: Sequence[float] = ANGLES, phi_o_deg: float = 0.0, fixed: Iterable[str] = (),
    against: Model | None = None, points: str = "sobol", samples: int = SAMPLES, seed: int = 0,
    threads: int | None = None, tolerance: float | None = None, effort: float = 1.0,
    tolerances: Mapping[str, float] = MappingProxyType({}), deadline: Deadline | None = None,
    progress: Progress | None = None, heard: Heard | None = None,
) -> Report:  # fmt: skip
    """Every check of a model, or those named, for one or several parameter sets.

    model: from `load`. p: a parameter set of `model.parameters`, a list of them, or None for the
    defaults and a search for the worst over the ranges of all parameters. names: of checks, None
    for all. theta_o_deg, phi_o_deg: the viewer's polar angles in [0, 90) and azimuth, in degrees,
    for checks that look at some. fixed: parameters that searches leave alone; the others are
    searched over their range, also where `p` is given. against: a model that it must equal.
    points: "sobol", "independent", "stratified" or "lattice". samples: the most that a claim may
    take, 1 to 2^40. seed: 0 to 2^64 - 1. threads: 1 to 1024, None for all processors; no result
    depends on it. tolerance: in [0, 1), instead of each claim's own, but for the laws: reciprocity,
    isotropy, positivity. tolerances: the same for single checks by name, these too. effort: the
    share, in (0, 1], of the pairs, places and nodes that checks look at: a look in passing, which
    may miss what a whole one finds. deadline: no claim is begun after it, and what is left is
    inconclusive. progress: is called with the fraction done. heard: is called with a
    Result of what a check found so far and whether that is all of it, after each finding.

    Returns a Report with one Result per parameter set and check; an interruption returns what was
    found so far, and says so in `measured`; a check that the model ends by an exception has the
    verdict "error". Raises UserError for a bad value, ModelError if the model does not run in any
    check.
    """
    asked = chosen("check", names or "all", checks.names())
    asked = [name for name in checks.names() if name in asked]
    asked = checks.asked(model) if asked == checks.names() else asked
    angles = [check_theta(a) for a in theta_o_deg]
    reach = REACH if samples == SAMPLES else 0  # who says another number means it
    settings = Settings.of(points, samples, seed, threads, tolerance, effort=effort, reach=reach)
    allowed = _allowed(settings, chosen("check", [*tolerances], checks.names()), tolerances)
    started = time.perf_counter()
    groups = []
    for one in parameter_sets(model, p):
        variant = model.of(one)
        free = searched(variant, dict.fromkeys(fixed)) if p is None or fixed else ()
        where = variant, one, angles, phi_o_deg, None, None, free
        case = Case(*where, against=against, seed=seed, effort=effort)
        cases = {n: case._replace(tolerance=allowed.get(n)) for n in asked}
        groups.append([Task(Question(n, c, checks.find(n).claims)) for n, c in cases.items()])
    why, interrupted = "--max-time was over", False
    try:
        perform(groups, settings, deadline or Deadline(), progress, heard)
    except KeyboardInterrupt:
        why, interrupted = "interrupted", True
    told = {"checks": asked, "theta_o_deg": angles, "tolerance": tolerance, **settings.told()}
    told |= {"tolerances": dict(tolerances)} if tolerances else {}
    found = [[task.result(why) for task in group] for group in groups]
    _raise_if_nothing_ran([result for some in found for result in some])
    results, diagnosis = _diagnosed(groups, found, settings, interrupted)
    times = [task.seconds for group in groups for task in group]
    report = reported(Command.RUN, told, results, started, times)
    report.measured["interrupted"] = interrupted
    return replace(report, diagnosis=diagnosis)


def _diagnosed(
    groups: Sequence[Sequence[Task]], found: Sequence[Sequence[Result]], settings: Settings,
    interrupted: bool,
) -> tuple[list[Result], list[Diagnosis]]:
    """The results, with what follows from a cause marked, and a diagnosis of each case that
    failed."""
    results, told = list[Result](), list[Diagnosis]()
    if interrupted or not any(r.verdict == Verdict.FAIL for some in found for r in some):
        return [r for some in found for r in some], told
    from montecarlo_brdf import diagnosis as causes  # imports numpy

    for group, some in zip(groups, found, strict=True):
        case = group[0].question.case._replace(tolerance=None)
        if (one := causes.diagnose(case, some)) is None:
            results += some
            continue
        results += causes.marked(some, one)
        asked = {task.question.name: task.question.case for task in group}
        again = _again(asked[one.place.check], settings, one.place)
        told.append(replace(one, place=replace(one.place, reproduce=again)))
    return results, told


def _allowed(
    settings: Settings, named: Sequence[str], tolerances: Mapping[str, float]
) -> dict[str, float]:
    """The tolerance of each check that has another than its own: a law is not made looser by what
    is allowed of values."""
    values = [n for n in checks.names() if checks.find(n).PROPERTY not in LAWS]
    found = {} if settings.tolerance is None else dict.fromkeys(values, settings.tolerance)
    for name in named:
        Settings.of(tolerance=tolerances[name])  # refuses what is no tolerance
    return {**found, **tolerances}


def _raise_if_nothing_ran(results: Sequence[Result]) -> None:
    """A model that fails in all checks does not run: that is no report."""
    findings = [f for r in results for f in r.findings if f.verdict != Verdict.SKIPPED]
    if findings and all(f.verdict == Verdict.ERROR for f in findings):
        raise ModelError(str(findings[0].note))


@dataclass
class Task:
    """One check of one case, and what is found so far."""

    question: Question
    findings: list[Finding] = field(default_factory=list)
    begun: bool = False
    done: bool = False
    slow: str = ""  # why the model could not even be evaluated once
    seconds: float = 0.0  # that it took, side by side with others
    waiting: bool = False  # for the model to return from its first evaluations

    @property
    def share(self) -> float:
        """How much of it is done, for progress."""
        return 1.0 if self.done else 0.5 if self.findings else 0.0

    def result(self, why: str) -> Result:
        """The findings, and one more that is inconclusive if the task is not done."""
        findings = list(self.findings)
        if not self.done:
            late = self.slow or f"not {'finished' if self.begun else 'begun'}: {why}"
            if self.waiting:
                late += " before the model returned from its first few evaluations"
            findings.append(Finding(self.question.name, {}, Verdict.INCONCLUSIVE, note=late))
        return self.question.result(findings)

    def fill(self, settings: Settings, plan: Plan, deadline: Deadline, tell: Told) -> None:
        """Decide the claims, each begun before the deadline."""
        name, case, claims = self.question
        repeat = functools.partial(_repeat, case, name, settings)
        self.begun, began = True, time.perf_counter()
        try:
            with failure.of_case(case):
                for claim in claims(case):
                    if deadline.over():
                        return
                    self.findings.append(judged(claim, plan, case.model.disclaims, repeat))
                    self.seconds = time.perf_counter() - began
                    tell(self)
        except ModelError as error:
            self.findings.append(Finding(name, {}, Verdict.ERROR, note=str(error)))
        self.done = True
        tell(self)


Told = Callable[[Task], None]


def perform(
    groups: Sequence[Sequence[Task]], settings: Settings, deadline: Deadline,
    progress: Progress | None = None, heard: Heard | None = None,
) -> None:  # fmt: skip
    """Do the tasks of one case after another until the deadline; those of a case side by side."""

    def tell(task: Task) -> None:
        if heard:
            heard(task.question.result([*task.findings]), task.done)
        if progress:
            progress(sum(t.share for g in groups for t in g) / sum(map(len, groups)))

    plan = settings.plan
    together = min(plan.threads, MOST)
    alone = plan._replace(threads=max(1, plan.threads // together))
    for group in groups:
        look = functools.partial(_first_look, group)
        if deadline.over() or not supervised(look, deadline, GRACE):
            return
        if not group[0].slow:
            # the last has soon all threads to itself; `next` of a list's iterator is atomic
            rest = iter([*((task, alone) for task in group[:-1]), (group[-1], plan)])
            work = functools.partial(_work, rest, settings, deadline, tell)
            if not supervised(work, deadline, GRACE, together):
                return


def _first_look(tasks: Sequence[Task]) -> None:
    """Find out whether the model of some tasks can be sampled; if this is left they can tell."""
    for task in tasks:
        task.waiting = True
    slow, case = "", tasks[0].question.case
    try:
        probed(case.model, case.p)
    except TooSlow as error:
        slow = str(error)
    for task in tasks:
        task.slow, task.waiting = slow, False


def _work(
    rest: Iterator[tuple[Task, Plan]], settings: Settings, deadline: Deadline, tell: Told
) -> None:
    """Take tasks and do them until none is left or the deadline is over."""
    for task, plan in rest:
        if deadline.over():
            return
        task.fill(settings, plan, deadline, tell)


def _repeat(case: Case, name: str, settings: Settings, finding: Finding) -> str:
    """The command line that gives a finding again."""
    words = ["brdf-check", "run", "--model", case.model.name, "--check", name]
    free = {case.model.labels.get(n, n) for n in case.free}
    for key, value in shown_parameters(case.model, case.p).items():
        values = value if isinstance(value, tuple) else (value,)
        words += [] if key in free else ["-p", f"{key}={'/'.join(map(str, values))}"]
    words += ["--theta-o", ",".join(map(exactly, case.theta_o_deg))]
    words += ["--phi-o", exactly(case.phi_o_deg)] if case.phi_o_deg else []
    return shlex.join([*words, *_terms(case, name, settings)])


def _again(case: Case, settings: Settings, place: Place) -> str:
    """The command line that shows the worst finding again, with the parameters and the angle where
    it was found."""
    model, where = case.model, place.finding.where
    words = ["brdf-check", "run", "--model", model.name, "--check", place.check]
    one = len(case.sets) == 1
    for key, value in shown_parameters(model, case.p).items():
        there = where.get(key, value) if one else value
        values = there if isinstance(there, tuple) else (there,)
        changed = key in where or value != shown_parameters(model, model.parameters()).get(key)
        words += ["-p", f"{key}={'/'.join(map(_short, values))}"] if changed else []
    theta = where.get("theta_o_deg", where.get("theta_i_deg"))
    if isinstance(theta, float | int):
        words += ["--theta-o", _short(min(float(theta), 89.9999))]  # commands take less than 90
        phi = where.get("phi_o_deg", where.get("phi_i_deg", case.phi_o_deg))
        words += ["--phi-o", _short(phi)] if phi and not model.isotropic else []
    return shlex.join([*words, *_terms(case, place.check, settings)])


def _terms(case: Case, check: str, settings: Settings) -> list[str]:
    """What a command line says of how a check was asked."""
    words = settings.options(SAMPLES)
    words += ["--against", case.against.name] if case.against else []
    if case.tolerance is not None:
        words += ["--tolerance", f"{check}={exactly(case.tolerance)}"]
    return words


def _short(value: Any) -> str:
    """As a finding's place has it: enough digits to meet it again."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
