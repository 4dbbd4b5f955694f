"""All checks of a model, in time, interruptible, each finding with a command that repeats it.

The checks run where they can be left (verify.supervision); what they left undone is inconclusive.
"""
from __future__ import annotations

import math
import shlex
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from montecarlo_brdf import checks
from montecarlo_brdf.checks.case import Case, searched
from montecarlo_brdf.errors import TooSlow, UserError, unknown
from montecarlo_brdf.integration.arguments import check_theta
from montecarlo_brdf.integration.plan import Plan
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.findings import Finding, Report, Result
from montecarlo_brdf.report.judge import decide
from montecarlo_brdf.verify.common import (
    Deadline,
    Progress,
    check_tolerance,
    exactly,
    plan_settings,
    planned,
    reported,
    shared_progress,
    shown_parameters,
)
from montecarlo_brdf.verify.subject import probed, source
from montecarlo_brdf.verify.supervision import supervised

RUN_ANGLES = (0.0, 45.0, 80.0)
RUN_SAMPLES = 1 << 20
GRACE = 1.0  # seconds that a claim may go on after --max-time


@dataclass
class Task:
    """One check of one case, and what is found so far."""

    case: Case
    check: str
    findings: list[Finding] = field(default_factory=list)
    begun: bool = False
    done: bool = False
    slow: str = ""  # why the model could not even be evaluated once
    waiting: bool = False  # for the model to return from its first evaluations

    def result(self, why: str) -> Result:
        """The findings; if it is not done one more is inconclusive, never forgotten."""
        case, findings = self.case, list(self.findings)
        if not self.done:
            late = self.slow or f"not {'finished' if self.begun else 'begun'}: {why}"
            if self.waiting:
                late += " before the model returned from its first few evaluations"
            findings.append(Finding(self.check, {}, "inconclusive", note=late))
        shown = shown_parameters(case.model, case.p)
        return Result(case.model.name, shown, self.check, findings, source=source(case.model))


def run(
    model: Model,
    p: Any = None,
    *,
    names: Sequence[str] | None = None,
    theta_o_deg: Sequence[float] = RUN_ANGLES,
    phi_o_deg: float = 0.0,
    fixed: Iterable[str] = (),
    against: Model | None = None,
    points: str = "sobol",
    samples: int = RUN_SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    tolerance: float | None = None,
    deadline: Deadline | None = None,
    progress: Progress | None = None,
) -> Report:
    """Every check (or those in `names`) of a model with one or several parameter sets.

    fixed: parameters that worst-case searches leave alone; the others are searched over their
    range unless `p` is given. deadline: stop in time and report what is left as inconclusive.
    Other arguments as for `furnace`. An interruption returns what was found so far.
    """
    chosen = _checks(names)
    sets = list(p) if isinstance(p, list) else [model.parameters() if p is None else p]
    angles = [check_theta(a) for a in theta_o_deg]
    plan = planned(points, samples, seed, threads)
    check_tolerance(tolerance)
    started = time.perf_counter()
    deadline = deadline or Deadline(math.inf)
    tasks = []
    for one in sets:
        variant = model.of(one)
        free = searched(variant, dict.fromkeys(fixed)) if p is None or fixed else ()
        case = Case(
            variant, one, angles, phi_o_deg, None, tolerance, free, against=against, seed=seed
        )
        tasks += [Task(case, name) for name in chosen]
    why, interrupted = "--max-time was over", False
    try:
        supervised(lambda: perform(tasks, plan, deadline, progress), deadline, GRACE)
    except KeyboardInterrupt:
        why, interrupted = "interrupted", True
    settings = {"checks": chosen, "theta_o_deg": angles, "tolerance": tolerance}
    settings |= plan_settings(plan)
    report = reported("run", settings, [task.result(why) for task in tasks], started)
    report.measured["interrupted"] = interrupted
    return report


def perform(
    tasks: Sequence[Task], plan: Plan, deadline: Deadline, progress: Progress | None = None
) -> None:
    """Do the tasks in their order until the deadline."""
    case, slow = None, ""
    for k, task in enumerate(tasks):
        if deadline.over():
            return
        if task.case is not case:
            case, slow = task.case, _first_look([t for t in tasks if t.case is task.case])
        if slow:
            task.slow = slow
        else:
            fill(task, plan, deadline, shared_progress(progress, k, len(tasks)))


def _first_look(tasks: Sequence[Task]) -> str:
    """Why the model of some tasks cannot be sampled; if this is left they can tell."""
    for task in tasks:
        task.waiting = True
    slow = too_slow(tasks[0].case)
    for task in tasks:
        task.waiting = False
    return slow


def too_slow(case: Case) -> str:
    """Why a model cannot be sampled at all; empty if it can."""
    try:
        probed(case.model, case.p)
    except TooSlow as error:
        return str(error)
    return ""


def fill(task: Task, plan: Plan, deadline: Deadline, progress: Progress | None = None) -> None:
    """Decide the claims of a task, begun before the deadline."""
    case, task.begun = task.case, True
    for claim in checks.find(task.check).claims(case):
        if deadline.over():
            return
        known = case.model.disclaims.get(getattr(claim, "property", ""))
        finding = decide(claim, plan, known)
        if finding.verdict not in ("pass", "skipped"):
            finding = replace(finding, reproduce=reproduction(case, task.check, plan))
        task.findings.append(finding)
        if progress:
            progress(0.5)
    task.done = True
    if progress:
        progress(1.0)


def reproduction(case: Case, name: str, plan: Plan) -> str:
    """A command line that gives this finding again."""
    words = ["brdf-check", "run", "--model", case.model.name, "--check", name]
    for key, value in shown_parameters(case.model, case.p).items():
        values = value if isinstance(value, tuple) else (value,)
        if not (case.free and key in {case.model.labels.get(n, n) for n in case.free}):
            words += ["-p", f"{key}={'/'.join(str(v) for v in values)}"]
    words += ["--theta-o", ",".join(map(exactly, case.theta_o_deg))]
    defaults = {
        "--phi-o": (exactly(case.phi_o_deg), "0"),
        "--points": (plan.points, "sobol"),
        "--samples": (plan.samples, RUN_SAMPLES),
        "--seed": (plan.seed, 0),
        "--against": (case.against.name if case.against else None, None),
    }
    for option, (value, default) in defaults.items():
        words += [option, str(value)] if value != default else []
    if case.tolerance is not None:
        words += ["--tolerance", exactly(case.tolerance)]
    return shlex.join(words)


def _checks(names: Sequence[str] | None) -> list[str]:
    known = checks.names()
    for name in names or ():
        if name not in known:
            raise UserError(unknown("check", name, known))
    return [n for n in known if not names or n in names]
