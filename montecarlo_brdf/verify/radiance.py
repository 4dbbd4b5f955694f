"""The reflected radiance of a scene: estimated, held against its truth, and its energy judged."""

from __future__ import annotations

import functools
import shlex
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from montecarlo_brdf.estimate.plan import Plan, Progress
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound, Command, Finding, Report, Result, Verdict
from montecarlo_brdf.model import Property
from montecarlo_brdf.report.text import place
from montecarlo_brdf.scene import claims as scene_claims
from montecarlo_brdf.scene import plan as planning
from montecarlo_brdf.scene.claims import reversed_scene
from montecarlo_brdf.scene.plan import ScenePlan
from montecarlo_brdf.scene.scene import Scene, as_lobes
from montecarlo_brdf.scene.standard import Standard, mend
from montecarlo_brdf.verify import failure
from montecarlo_brdf.verify.question import (
    SAMPLES,
    Settings,
    decided,
    exactly,
    probed,
    reported,
)

WEIGHT_ROUNDING = 1e-12  # weights like 0.1 + 0.2 + 0.7 add up to 1 only within rounding
WEIGHTS = "sum of weights <= 1"


def radiance(
    scene: Scene, *, skip: bool = True, energy: bool = True, points: str = "sobol",
    samples: int = SAMPLES, seed: int = 0, threads: int | None = None,
    tolerance: float | None = None, progress: Progress | None = None,
) -> Report:  # fmt: skip
    """Reflected radiance L_o of a scene at all its views, per channel, with verdicts.

    scene: from `read_scene` or `scene_of`. skip: leave out what the scene does not need (never
    changes a result beyond rounding and its error bar). energy: also judge A <= 1, and R <= 1 if
    the surface is not reciprocal. points: "sobol", "independent", "stratified" or "lattice".
    samples: the most that a claim may take, 1 to 2^40. seed: 0 to 2^64 - 1. threads: 1 to 1024,
    None for all processors; no result depends on it. tolerance: in [0, 1), relative for L_o,
    absolute for A <= 1; None for 1e-4 and 1e-5. progress: is called with the fraction done.

    Returns a Report with one Result; radiances in the unit of the scene's lights. Raises UserError
    for a bad value, ModelError if a model fails, TooSlow if one does not return.
    """
    settings = Settings.of(points, samples, seed, threads, tolerance)
    started = time.perf_counter()
    for lobe in as_lobes(scene).lobes:
        for p in dict.fromkeys(lobe.sets):
            probed(lobe.model, p)
    with failure.of_lobes(as_lobes(scene).lobes):
        plan = planning.make(scene, skip)
        findings = decided(
            _claims(scene, plan, tolerance, skip, energy), settings.plan, _disclaims(scene),
            functools.partial(_repeat, scene, settings, skip), count=_count(scene, energy),
            progress=progress,
        )  # fmt: skip
    view = {"theta_o_deg": [*scene.view.theta_o_deg], "phi_o_deg": [*scene.view.phi_o_deg]}
    told = {**view, "skip": skip, "tolerance": tolerance, "plan": explained(plan, settings.plan)}
    result = Result(scene.name, {}, "radiance", _with_reading(scene, findings))
    return reported(Command.RADIANCE, {**told, **settings.told()}, [result], started)


def _claims(
    scene: Scene, plan: ScenePlan, tolerance: float | None, skip: bool, energy: bool
) -> Iterator[Claim]:
    for k, total in enumerate(scene_claims.weight_sums(scene)):
        hint = None if total <= 1.0 else "reduce a weight"
        yield ExactClaim(
            WEIGHTS, {"channel": k} if scene.channels > 1 else {}, Bound.AT_MOST,
            Reference(1.0, 0.0, Kind.BOUND, "lobes share the light that arrives"), WEIGHT_ROUNDING,
            functools.partial(Exact, total, hint=hint), property=None,
        )  # fmt: skip
    yield from scene_claims.claims(scene, plan, tolerance)
    if energy or scene.band:
        furnace = planning.make(scene.under_constant_light(1.0), skip)
        if energy:
            yield from scene_claims.energy_claims(scene, furnace, tolerance)
            if reverse := reversed_scene(furnace.scene):
                plan = planning.make(reverse, skip)
                yield from scene_claims.energy_claims(scene, plan, tolerance, reverse=True)
        yield from scene_claims.band_claims(scene, furnace, tolerance)


def _count(scene: Scene, energy: bool) -> int:
    thetas, phis = len(scene.view.theta_o_deg), len(scene.view.phi_o_deg)
    return scene.channels * thetas * (phis + energy) + (thetas if scene.band else 0)


def _disclaims(scene: Scene) -> dict[str, str]:
    """Why a refuted claim is no surprise: nobody ever made it."""
    if isinstance(scene.surface, Standard):
        return {Property.ENERGY: "the standard lighting equation does not conserve energy"}
    lit = (lobe.model for lobe in scene.surface.lobes if any(lobe.weights))
    reasons = [m.disclaims[Property.ENERGY] for m in lit if Property.ENERGY in m.disclaims]
    return {Property.ENERGY: reasons[0]} if reasons else {}


def _repeat(scene: Scene, settings: Settings, skip: bool, finding: Finding) -> str | None:
    """A command line that gives this finding again; None for a scene made by hand."""
    if not scene.words:
        return None
    words = ["brdf-check", "radiance", *scene.words]
    angles = [finding.where[k] for k in ("theta_o_deg", "theta_i_deg") if k in finding.where]
    words += [word for theta in angles for word in ("--theta-o", exactly(theta))]
    words += [*settings.options(), *settings.tolerance_option()]
    return shlex.join(words if skip else [*words, "--no-skip"])


def _with_reading(scene: Scene, findings: list[Finding]) -> list[Finding]:
    """By how much the standard lighting equation gains energy, and which factors would mend it."""
    gains = [f for f in findings if f.verdict == Verdict.KNOWN]
    if not gains or not isinstance(scene.surface, Standard):
        return findings
    worst = max(gains, key=lambda f: f.value)
    told = f"it reflects up to {worst.value:.4g} times what arrives ({place(worst)})"
    note = f"{worst.note}: {told}; {mend(scene.surface)}"
    return [replace(f, note=note, hint=None) if f.verdict == Verdict.KNOWN else f for f in findings]


def explained(plan: ScenePlan, sampling: Plan) -> list[dict[str, Any]]:
    """The plan as plain data, with the most samples that each line may save."""
    views = len(set(plan.views.values()))
    rows = []
    for item in plan.items:
        saved = 0 if item.evaluated else item.estimates * views * sampling.samples
        decision = "evaluated" if item.evaluated else "skipped"
        row = {"what": item.what, "decision": decision, "why": item.reason}
        rows.append({**row, "samples_saved": saved})
    return rows
