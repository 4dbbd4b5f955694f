"""Error against samples of a model: slopes, claims, samples needed."""
from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import Any

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.arguments import check_theta
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import charts_of, samplers_of
from montecarlo_brdf.judge.claim import Reference
from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import SETS
from montecarlo_brdf.verify import _convergence as check
from montecarlo_brdf.verify.common import (
    Progress,
    plan_settings,
    planned,
    reported,
    shared_progress,
    shown_parameters,
)

SAMPLES = 1 << 21  # per level, over all randomisations


def converge(
    model: Model,
    p: Any = None,
    theta_o_deg: float = 60.0,
    *,
    phi_o_deg: float = 0.0,
    sampler: str | Sequence[str] = "all",
    points: str | Sequence[str] = "all",
    samples: int = SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Report:
    """How fast the error of A falls for each sampler and point set, against the claimed rate.

    sampler, points: "all" or some by name. samples: the most that one number of samples may take
    over its 32 randomisations. Raises UserError for a bad value, ModelError if the model does not
    run.
    """
    sets = list(p) if isinstance(p, list) else [model.parameters() if p is None else p]
    theta = check_theta(theta_o_deg)
    offered = (*charts_of(model), *samplers_of(model))
    samplers = _chosen("sampler", sampler, offered)
    chosen = _chosen("point set", points, tuple(SETS))
    plan = planned(chosen[0], samples, seed, threads)
    started = time.perf_counter()
    results = []
    for i, one in enumerate(sets):
        variant = model.of(one)
        probe.check(variant, one)
        case = Case(variant, one, [theta], phi_o_deg, seed=seed)
        share = shared_progress(progress, i, len(sets))
        findings = _findings(case, theta, samplers, chosen, plan, share)
        results.append(Result(model.name, shown_parameters(variant, one), check.NAME, findings))
    settings = {"theta_o_deg": theta, "phi_o_deg": phi_o_deg, "sampler": samplers}
    settings |= {**plan_settings(plan), "points": ", ".join(chosen)}
    return reported("converge", settings, results, started)


def _findings(
    case: Case,
    theta: float,
    samplers: Sequence[str],
    points: Sequence[str],
    plan: Plan,
    progress: Progress | None,
) -> list[Finding]:
    known = reference_of(case, theta)
    total = len(samplers) * len(points)
    findings = []
    for curve in check.curves(case, theta, samplers, points, plan, known):
        findings.append(finding(curve, case.where(theta_o_deg=theta), known))
        if progress:
            progress(len(findings) / total)
    return findings


def _chosen(kind: str, asked: str | Sequence[str], offered: tuple[str, ...]) -> list[str]:
    if asked == "all":
        return list(offered)
    chosen = [asked] if isinstance(asked, str) else list(asked)
    for name in chosen:
        if name not in offered:
            raise UserError(unknown(kind, name, ("all", *offered)))
    return chosen


def reference_of(case: Case, theta: float) -> Reference:
    """The reference; for a model without one, an adaptive estimate with its own error bar."""
    found = _truth.albedo(case.model, case.one, theta, case.phi_o_deg)
    if found is None or not found.value:
        e = directional_albedo(
            case.model, case.one, theta, phi_o_deg=case.phi_o_deg, target_error=1e-10
        )
        found = Reference(e.mean, 4.0 * e.stderr, "adaptive estimate of the same f", e.method)
    if not found.value:
        raise UserError(f"model {case.model.name} reflects nothing here: no relative error")
    return found


def finding(curve: check.Curve, where: dict[str, Any], known: Reference) -> Finding:
    """A curve as a finding: the slope is the value, the claim what it must be at most."""
    fit = curve.fit
    kind = "smooth in the fitted chart" if curve.smooth else "cut or kinked"
    return Finding(
        quantity="slope",
        where={**where, "sampler": curve.sampler, "points": curve.points},
        verdict=curve.verdict,
        bound="at most",
        value=fit.slope if fit else math.nan,
        stderr=fit.stderr if fit else math.nan,
        expected=curve.claim,
        tolerance=check.SLACK,
        level=check.LEVEL,
        samples=curve.levels[-1].samples if curve.levels else 0,
        reference={"kind": known.kind, "source": known.source, "error": curve.floor},
        estimators=[_row(v) for v in curve.levels],
        note=_needs(curve, kind),
    )


def _needs(curve: check.Curve, kind: str) -> str:
    """Samples of one randomisation for each target, extrapolated ones in brackets."""
    name = f"{curve.sampler} x {curve.points} ({kind})"
    last = curve.levels[-1].samples if curve.levels else 0
    needs = {t: curve.needed(t) for t in check.TARGETS}
    text = ", ".join(f"{t:g}: {_shown(n, n > last)}" for t, n in needs.items())
    if curve.fit:
        low, high = (curve.fit.slope + s * curve.fit.half_width(check.SHOWN) for s in (-1, 1))
        return f"{name}: slope in [{low:.2f}, {high:.2f}]; samples for {text}"
    worst = max((v.error for v in curve.levels), default=0.0)
    reason = "too few errors between 10 % and rounding"
    reason = "exact at every N" if worst < check.CONSTANT else reason
    return f"{name}: no slope, {reason}; samples for {text}"


def _shown(samples: float, extrapolated: bool) -> str:
    if not math.isfinite(samples):
        return "never"
    text = f"2^{math.log2(samples):.1f}" if extrapolated else f"2^{math.log2(samples):.0f}"
    return f"({text})" if extrapolated else text


def _row(level: check.Level) -> dict[str, Any]:
    return {
        "estimator": f"N = {level.samples}",
        "samples": level.samples,
        "value": level.error,
        "stderr": level.error * level.uncertainty * math.log(2.0),
        "verdict": "",
        "randomisations": list(level.each),
    }
