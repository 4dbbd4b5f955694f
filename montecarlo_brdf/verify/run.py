"""All checks of a model, in time, interruptible, each finding with a command that repeats it.

The checks run where they can be left (verify.tasks); what they left undone is inconclusive.
"""
from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from typing import Any

from montecarlo_brdf import checks
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate.arguments import check_theta
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify.common import (
    Deadline,
    Progress,
    check_effort,
    check_tolerance,
    plan_settings,
    planned,
    reported,
)
from montecarlo_brdf.verify.reproduction import RUN_SAMPLES
from montecarlo_brdf.verify.tasks import Task, perform

RUN_ANGLES = (0.0, 45.0, 80.0)


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
    effort: float = 1.0,
    deadline: Deadline | None = None,
    progress: Progress | None = None,
) -> Report:
    """Every check (or those in `names`) of a model with one or several parameter sets.

    fixed: parameters that worst-case searches leave alone; the others are searched over their
    range unless `p` is given. effort: the share, in (0, 1], of the pairs, places and nodes that
    checks look at: a look in passing, which may miss what a whole one finds. deadline: stop in time
    and report what is left as inconclusive. Other arguments as for `furnace`. An interruption
    returns what was found so far.
    """
    chosen = _checks(names)
    sets = list(p) if isinstance(p, list) else [model.parameters() if p is None else p]
    angles = [check_theta(a) for a in theta_o_deg]
    plan = planned(points, samples, seed, threads)._replace(effort=check_effort(effort))
    check_tolerance(tolerance)
    started = time.perf_counter()
    deadline = deadline or Deadline(math.inf)
    groups = []
    for one in sets:
        variant = model.of(one)
        free = searched(variant, dict.fromkeys(fixed)) if p is None or fixed else ()
        where = variant, one, angles, phi_o_deg, None, tolerance, free
        case = Case(*where, against=against, seed=seed, effort=effort)
        groups.append([Task(case, name) for name in chosen])
    why, interrupted = "--max-time was over", False
    try:
        perform(groups, plan, deadline, progress)
    except KeyboardInterrupt:
        why, interrupted = "interrupted", True
    settings = {"checks": chosen, "theta_o_deg": angles, "tolerance": tolerance}
    settings |= plan_settings(plan)
    results = [task.result(why) for group in groups for task in group]
    report = reported("run", settings, results, started)
    report.measured["interrupted"] = interrupted
    return report


def _checks(names: Sequence[str] | None) -> list[str]:
    known = checks.names()
    for name in names or ():
        if name not in known:
            raise UserError(unknown("check", name, known))
    return [n for n in known if not names or n in names]
