"""What a scene claims: its reflected radiance, and that its surface conserves energy.

Per view and channel: L_o equals its reference; the surface's albedo A (its radiance under a
constant light 1) is at most 1; over a band, the albedo weighted with the illuminant.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import Any

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, BOUND_TOLERANCE, MeanClaim, Reference
from montecarlo_brdf.scene import plan as planning
from montecarlo_brdf.scene import radiance, standard, truth
from montecarlo_brdf.scene.plan import ScenePlan, View
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.spectrum import band_albedo
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.standard_lobes import as_lobes
from montecarlo_brdf.scene.surface import Surface
from montecarlo_brdf.vectors import Vec, from_degrees


def plan_of(scene: Scene, skip: bool = True) -> ScenePlan:
    """The plan of a scene; of the standard lighting equation, that of its lobes."""
    plan = planning.make(as_lobes(scene), skip)
    if any(scene.ambient):  # of the standard equation: it is part of what its lobes emit
        plan = plan._replace(items=[i for i in plan.items if i.what != "ambient"])
    return plan


def claims(scene: Scene, plan: ScenePlan, tolerance: float | None = None) -> Iterator[MeanClaim]:
    """L_o for every view and channel."""
    for view, evaluated in plan.views.items():
        wo = from_degrees(*evaluated)
        measure = _radiance(scene, plan, wo)
        for k in range(scene.channels):
            expected = truth.reference(plan.scene, from_degrees(*view), k)
            relative = AGREEMENT_TOLERANCE if tolerance is None else tolerance
            yield MeanClaim(
                "L_o",
                place(scene, view, k),
                "equal",
                expected,
                relative * abs(expected.value),
                functools.partial(_channel, measure, k),
            )


def _radiance(scene: Scene, plan: ScenePlan, wo: Vec) -> Any:
    """L_o of all channels, computed once per number of samples."""
    if isinstance(scene.surface, Standard):
        return functools.partial(_shaded, scene, scene.surface, plan, wo)
    return _remembered(plan, wo)


@functools.lru_cache(maxsize=64)
def _key(plan: int, wo: Vec) -> dict[Any, Any]:
    return {}


def _remembered(plan: ScenePlan, wo: Vec) -> Any:
    """Views that share an evaluation share its estimates."""
    known = _key(id(plan), wo) if plan.skip else {}
    known.setdefault("plan", plan)  # keeps the id from being used again

    def measure(sampling: Plan) -> list[Measurement]:
        at = sampling._replace(progress=None)
        if at not in known:
            known[at] = radiance.measure(plan, wo, sampling)
        return known[at]  # type: ignore[no-any-return]

    return measure


def _shaded(
    scene: Scene, s: Standard, plan: ScenePlan, wo: Vec, sampling: Plan
) -> list[Measurement]:
    """The standard lighting equation as it is written."""
    colour = standard.shade(s, wo, plan.lights, scene.ambient, scene.emission)
    return [Measurement("equation", radiance.combined(c, [])) for c in colour]


def _channel(measure: Any, k: int, sampling: Plan) -> list[Measurement]:
    return [measure(sampling)[k]]


def energy_claims(
    scene: Scene, furnace: ScenePlan, tolerance: float | None, reverse: bool = False
) -> Iterator[MeanClaim]:
    """A <= 1 at every polar angle of the view, or R <= 1 with the light there."""
    angle, quantity = ("theta_i_deg", "R <= 1") if reverse else ("theta_o_deg", "A <= 1")
    for theta in dict.fromkeys(theta for theta, _ in furnace.views):
        view = (theta, scene.view.phi_o_deg[0])
        measure = _remembered(furnace, from_degrees(*furnace.views[view]))
        for k in range(scene.channels):
            yield MeanClaim(
                quantity,
                place(scene, view, k, angle),
                "at most",
                Reference(1.0, 0.0, "bound", "energy conservation"),
                BOUND_TOLERANCE if tolerance is None else tolerance,
                functools.partial(_channel, measure, k),
                property="energy",
                unit={} if reverse else _units(scene, k),
            )


def _units(scene: Scene, channel: int) -> dict[str, float]:
    """What a hint may compare A with: the scale of the only lobe."""
    lobes = scene.surface.lobes if isinstance(scene.surface, Surface) else ()
    if len(lobes) != 1 or not lobes[0].model.scales_with:
        return {}
    name = lobes[0].model.scales_with
    value = float(getattr(lobes[0].sets[channel], name)) * lobes[0].weights[channel]
    return {name: value} if value else {}


def band_claims(scene: Scene, furnace: ScenePlan, tolerance: float | None) -> Iterator[MeanClaim]:
    """Albedo over the band: int A E dl / int E dl, linear in the albedos at the wavelengths."""
    if scene.band is None:
        return
    shares = band_shares(scene.band.wavelengths, scene.band.illuminant)
    for theta in dict.fromkeys(theta for theta, _ in furnace.views):
        view = (theta, scene.view.phi_o_deg[0])
        measure = _remembered(furnace, from_degrees(*furnace.views[view]))
        rows = [
            truth.reference(furnace.scene, from_degrees(*view), k) for k in range(scene.channels)
        ]
        value = math.fsum(s * r.value for s, r in zip(shares, rows, strict=True))
        error = math.fsum(s * r.error for s, r in zip(shares, rows, strict=True))
        relative = AGREEMENT_TOLERANCE if tolerance is None else tolerance
        yield MeanClaim(
            "albedo over the band",
            {"theta_o_deg": theta},
            "equal",
            Reference(value, error + 1e-15 * abs(value), rows[0].kind, rows[0].source),
            relative * abs(value),
            functools.partial(_weighted, measure, shares),
        )


def band_shares(wavelengths: tuple[float, ...], illuminant: Any) -> list[float]:
    """The weight of every wavelength in the band albedo: that of a spectrum that is 1 there."""
    units = ([(w, float(w == one)) for w in wavelengths] for one in wavelengths)
    return [band_albedo(tuple(unit), illuminant) for unit in units]


def _weighted(measure: Any, shares: list[float], sampling: Plan) -> list[Measurement]:
    rows = measure(sampling)
    parts = [(s, m.estimate) for s, m in zip(shares, rows, strict=True)]
    unfit = next((m.unfit for m in rows if m.unfit), None)
    return [Measurement(rows[0].estimator, radiance.combined(0.0, parts), unfit)]


def place(scene: Scene, view: View, channel: int, angle: str = "theta_o_deg") -> dict[str, Any]:
    """Where a finding stands."""
    where: dict[str, Any] = {angle: view[0]}
    if len(scene.view.phi_o_deg) > 1 or view[1]:
        where[angle.replace("theta", "phi")] = view[1]
    if scene.band:
        return {**where, "nm": scene.band.wavelengths[channel]}
    return {**where, "channel": channel} if scene.channels > 1 else where


def weight_sums(scene: Scene) -> list[float]:
    """kd + ks per channel; nothing for a single lobe of weight 1."""
    lobes = scene.surface.lobes if isinstance(scene.surface, Surface) else ()
    if len(lobes) < 2:
        return []
    return [math.fsum(lobe.weights[c] for lobe in lobes) for c in range(scene.channels)]
