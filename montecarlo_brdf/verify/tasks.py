"""Checks of cases as tasks, performed by several threads where they can be left."""
from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from montecarlo_brdf import checks
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.errors import TooSlow
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Finding, Result
from montecarlo_brdf.verify.common import Deadline, Progress, shown_parameters
from montecarlo_brdf.verify.reproduction import reproduction
from montecarlo_brdf.verify.subject import probed, source
from montecarlo_brdf.verify.supervision import supervised

GRACE = 1.0  # seconds that a claim may go on after --max-time
MOST = 4  # tasks at once: what they do between kernels shares one interpreter


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

    @property
    def share(self) -> float:
        """How much of it is done, for progress."""
        return 1.0 if self.done else 0.5 if self.findings else 0.0

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


def perform(
    groups: Sequence[Sequence[Task]],
    plan: Plan,
    deadline: Deadline,
    progress: Progress | None = None,
) -> None:
    """Do the tasks of one case after another until the deadline; those of a case side by side."""

    def tell() -> None:
        if progress:
            progress(sum(t.share for g in groups for t in g) / sum(map(len, groups)))

    together = min(plan.threads, MOST)
    for group in groups:
        look = functools.partial(_first_look, group)
        if deadline.over() or not supervised(look, deadline, GRACE):
            return
        if not group[0].slow:
            work = functools.partial(_work, _Queue(group, plan, together), deadline, tell)
            if not supervised(work, deadline, GRACE, together):
                return


def _first_look(tasks: Sequence[Task]) -> None:
    """Find out whether the model of some tasks can be sampled; if this is left they can tell."""
    for task in tasks:
        task.waiting = True
    slow = too_slow(tasks[0].case)
    for task in tasks:
        task.slow, task.waiting = slow, False


def too_slow(case: Case) -> str:
    """Why a model cannot be sampled at all; empty if it can."""
    try:
        probed(case.model, case.p)
    except TooSlow as error:
        return str(error)
    return ""


class _Queue:
    """Tasks for several threads, each with the plan that it is to follow."""

    def __init__(self, tasks: Sequence[Task], plan: Plan, together: int) -> None:
        alone = plan._replace(threads=max(1, plan.threads // together))
        # the last has soon all threads to itself
        self._rest = iter([*((task, alone) for task in tasks[:-1]), (tasks[-1], plan)])
        self._lock = threading.Lock()

    def __iter__(self) -> Iterator[tuple[Task, Plan]]:
        return self

    def __next__(self) -> tuple[Task, Plan]:
        with self._lock:
            return next(self._rest)


def _work(queue: _Queue, deadline: Deadline, tell: Callable[[], None]) -> None:
    """Take tasks and do them until none is left or the deadline is over."""
    for task, plan in queue:
        if deadline.over():
            return
        fill(task, plan, deadline, tell)


def fill(task: Task, plan: Plan, deadline: Deadline, tell: Callable[[], None]) -> None:
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
        tell()
    task.done = True
    tell()
