"""The reflected radiance of a scene: estimated, held against its truth, and its energy judged."""

from __future__ import annotations

import functools
import shlex
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Reference
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.sentences import place
from montecarlo_brdf.scene import claims as scene_claims
from montecarlo_brdf.scene import plan as planning
from montecarlo_brdf.scene.claims import reversed_scene
from montecarlo_brdf.scene.plan import ScenePlan
from montecarlo_brdf.scene.scene import Scene, as_lobes
from montecarlo_brdf.scene.standard import Standard, mend
from montecarlo_brdf.verify.common import (
    SAMPLES,
    Progress,
    check_tolerance,
    exactly,
    plan_settings,
    planned,
    reported,
)

WEIGHT_ROUNDING = 1e-12  # weights like 0.1 + 0.2 + 0.7 add up to 1 only within rounding


def radiance(
    scene: Scene,
    *,
    skip: bool = True,
    energy: bool = True,
    points: str = "sobol",
    samples: int = SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    tolerance: float | None = None,
    progress: Progress | None = None,
) -> Report:
    """Reflected radiance L_o of a scene at all its views, per channel, with verdicts.

    scene: from `read_scene` or `scene_of`. skip: leave out what the scene does not need (never
    changes a result beyond rounding and its error bar). energy: also judge A <= 1, and R <= 1 if
    the surface is not reciprocal. samples: the most that a claim may take. Raises UserError for a
    bad value, ModelError if a model fails.
    """
    sampling = planned(points, samples, seed, threads)
    check_tolerance(tolerance)
    started = time.perf_counter()
    for lobe in as_lobes(scene).lobes:
        for p in dict.fromkeys(lobe.sets):
            probe.check(lobe.model, p)
    plan = planning.make(scene, skip)
    findings: list[Finding] = []
    total = _count(scene, energy)
    for claim in _claims(scene, plan, tolerance, skip, energy):
        finding = decide(claim, sampling, _known(scene, claim))
        if finding.verdict not in ("pass", "skipped"):
            command = reproduction(scene, finding, sampling, skip, tolerance)
            finding = replace(finding, reproduce=command)
        findings.append(finding)
        if progress:
            progress(min(1.0, len(findings) / total))
    settings = {
        "theta_o_deg": list(scene.view.theta_o_deg),
        "phi_o_deg": list(scene.view.phi_o_deg),
        "skip": skip,
        "tolerance": tolerance,
        "plan": explained(plan, sampling),
        **plan_settings(sampling),
    }
    result = Result(scene.name, {}, "radiance", _with_reading(scene, findings))
    return reported("radiance", settings, [result], started)


def _claims(
    scene: Scene, plan: ScenePlan, tolerance: float | None, skip: bool, energy: bool
) -> Iterator[Claim]:
    for k, total in enumerate(scene_claims.weight_sums(scene)):
        where = {"channel": k} if scene.channels > 1 else {}
        bound = Reference(1.0, 0.0, "bound", "lobes share the light that arrives")
        exact = Exact(total, hint=None if total <= 1.0 else "reduce a weight")
        yield ExactClaim(
            "sum of weights <= 1",
            where,
            "at most",
            bound,
            WEIGHT_ROUNDING,
            functools.partial(_same, exact),
            property="weights",
        )
    yield from scene_claims.claims(scene, plan, tolerance)
    if energy or scene.band:
        furnace = planning.make(scene.under_constant_light(1.0), skip)
        if energy:
            yield from scene_claims.energy_claims(scene, furnace, tolerance)
            if reverse := reversed_scene(furnace.scene):
                plan = planning.make(reverse, skip)
                yield from scene_claims.energy_claims(scene, plan, tolerance, reverse=True)
        yield from scene_claims.band_claims(scene, furnace, tolerance)


def _same(value: Exact) -> Exact:
    return value


def _count(scene: Scene, energy: bool) -> int:
    thetas, phis = len(scene.view.theta_o_deg), len(scene.view.phi_o_deg)
    return scene.channels * thetas * (phis + energy) + (thetas if scene.band else 0)


def _known(scene: Scene, claim: Claim) -> str | None:
    """Why a refuted claim is no surprise: nobody ever made it."""
    if getattr(claim, "property", "") != "energy":
        return None
    if isinstance(scene.surface, Standard):
        return "the standard lighting equation does not conserve energy"
    reasons = [
        lobe.model.disclaims.get("energy") for lobe in scene.surface.lobes if any(lobe.weights)
    ]
    return next((r for r in reasons if r), None)


def reproduction(
    scene: Scene, finding: Finding, sampling: Plan, skip: bool, tolerance: float | None
) -> str | None:
    """A command line that gives this finding again; None for a scene made by hand."""
    if not scene.words:
        return None
    words = ["brdf-check", "radiance", *scene.words]
    angles = [v for k, v in finding.where.items() if k.startswith("theta")]
    words += [word for theta in angles for word in ("--theta-o", exactly(theta))]
    defaults: dict[str, tuple[Any, Any]] = {
        "--points": (sampling.points, "sobol"),
        "--samples": (sampling.samples, SAMPLES),
        "--seed": (sampling.seed, 0),
        "--tolerance": (None if tolerance is None else exactly(tolerance), None),
    }
    for option, (value, default) in defaults.items():
        words += [option, str(value)] if value != default else []
    return shlex.join(words if skip else [*words, "--no-skip"])


def _with_reading(scene: Scene, findings: list[Finding]) -> list[Finding]:
    """By how much the standard lighting equation gains energy, and which factors would mend it."""
    gains = [f for f in findings if f.verdict == "known"]
    if not gains or not isinstance(scene.surface, Standard):
        return findings
    worst = max(gains, key=lambda f: f.value)
    told = f"it reflects up to {worst.value:.4g} times what arrives ({place(worst)})"
    note = f"{worst.note}: {told}; {mend(scene.surface)}"
    return [replace(f, note=note, hint=None) if f.verdict == "known" else f for f in findings]


def explained(plan: ScenePlan, sampling: Plan) -> list[dict[str, Any]]:
    """The plan as plain data, with the most samples that each line may save."""
    views = len(set(plan.views.values()))
    rows = []
    for item in plan.items:
        saved = 0 if item.evaluated else item.estimates * views * sampling.samples
        decision = "evaluated" if item.evaluated else "skipped"
        rows.append(
            {"what": item.what, "decision": decision, "why": item.reason, "samples_saved": saved}
        )
    return rows
