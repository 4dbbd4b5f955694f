"""All checks of a model, in time, interruptible, each finding with a command that repeats it."""
from __future__ import annotations

import math
import shlex
import time
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from montecarlo_brdf import checks
from montecarlo_brdf.checks.case import Case, searched
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.integration import probe
from montecarlo_brdf.integration.estimators import Plan, check_theta
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.findings import Finding, Report, Result
from montecarlo_brdf.report.judge import decide
from montecarlo_brdf.verify.common import (
    Deadline,
    Progress,
    check_tolerance,
    plan_settings,
    planned,
    reported,
    shared_progress,
    shown_parameters,
)

RUN_ANGLES = (0.0, 45.0, 80.0)
RUN_SAMPLES = 1 << 20


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
    results: list[Result] = []
    total = len(sets) * len(chosen)
    interrupted = False
    try:
        for one in sets:
            variant = model.of(one)
            probe.check(variant, one)
            free = searched(variant, dict.fromkeys(fixed)) if p is None or fixed else ()
            case = Case(
                variant, one, angles, phi_o_deg, None, tolerance, free, against=against, seed=seed
            )
            for name in chosen:
                share = shared_progress(progress, len(results), total)
                results.append(check_one(case, name, plan, deadline, share))
    except KeyboardInterrupt:
        interrupted = True
    settings = {"checks": chosen, "theta_o_deg": angles, "tolerance": tolerance}
    settings |= plan_settings(plan)
    report = reported("run", settings, results, started)
    report.measured["interrupted"] = interrupted
    return report


def check_one(
    case: Case, name: str, plan: Plan, deadline: Deadline, progress: Progress | None = None
) -> Result:
    """One check of one case; what the deadline leaves undone is inconclusive, never forgotten."""
    shown = shown_parameters(case.model, case.p)
    findings: list[Finding] = []
    if deadline.over():
        late = Finding(name, {}, "inconclusive", note="not begun: --max-time was over")
        return Result(case.model.name, shown, name, [late])
    for claim in checks.find(name).claims(case):
        if deadline.over():
            note = "not finished: --max-time was over"
            findings.append(Finding(name, {}, "inconclusive", note=note))
            break
        known = case.model.disclaims.get(getattr(claim, "property", ""))
        finding = decide(claim, plan, known)
        if finding.verdict not in ("pass", "skipped"):
            finding = replace(finding, reproduce=reproduction(case, name, plan))
        findings.append(finding)
        if progress:
            progress(0.5)
    if progress:
        progress(1.0)
    return Result(case.model.name, shown, name, findings)


def reproduction(case: Case, name: str, plan: Plan) -> str:
    """A command line that gives this finding again."""
    words = ["brdf-check", "run", "--model", case.model.name, "--check", name]
    for key, value in shown_parameters(case.model, case.p).items():
        values = value if isinstance(value, tuple) else (value,)
        if not (case.free and key in {case.model.labels.get(n, n) for n in case.free}):
            words += ["-p", f"{key}={'/'.join(str(v) for v in values)}"]
    words += ["--theta-o", ",".join(f"{t:g}" for t in case.theta_o_deg)]
    defaults = {"--samples": (plan.samples, RUN_SAMPLES), "--seed": (plan.seed, 0)}
    for option, (value, default) in defaults.items():
        words += [option, str(value)] if value != default else []
    if case.tolerance is not None:
        words += ["--tolerance", f"{case.tolerance:g}"]
    return shlex.join(words)


def _checks(names: Sequence[str] | None) -> list[str]:
    known = checks.names()
    for name in names or ():
        if name not in known:
            raise UserError(unknown("check", name, known))
    return [n for n in known if not names or n in names]
