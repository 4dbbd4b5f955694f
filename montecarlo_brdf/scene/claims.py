"""What a scene claims: its reflected radiance, and that its surface conserves energy.

Per view and channel: L_o equals its reference; the surface's albedo A (its radiance under a
constant light 1) is at most 1; over a band, the albedo weighted with the illuminant.
"""

from __future__ import annotations

import functools
import itertools
import math
import types
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import furnace
from montecarlo_brdf.checks._truth import AIM, as_measurement
from montecarlo_brdf.compile.bind import hole, plain
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import (
    AGREEMENT_TOLERANCE,
    BOUND_TOLERANCE,
    Kind,
    MeanClaim,
    Reference,
)
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property
from montecarlo_brdf.scene import radiance, standard, truth
from montecarlo_brdf.scene.expected import Expected, named_values
from montecarlo_brdf.scene.plan import Angles, ScenePlan
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.skies import Constant
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.vectors import Vec, from_degrees

F: Callable[..., float] = hole()
Measure = Callable[[Plan], list[Measurement]]  # one measurement per channel

FINEST = 1e-12  # relative error that is asked of a quadrature at most
ROUNDING = 1e-9  # relative: f of large exponents in two orders of evaluation
PAIRS = tuple(
    itertools.combinations([from_degrees(11.0 + 15.0 * k, 67.0 * k) for k in range(6)], 2)
)


def claims(scene: Scene, plan: ScenePlan, tolerance: float | None = None) -> Iterator[MeanClaim]:
    """L_o for every view and channel; the tolerance is relative."""
    for view, evaluated in plan.views.items():
        measure = _radiance(scene, plan, from_degrees(*evaluated))
        for k in range(scene.channels):
            where = place(scene, view, k)
            if scene.expected:
                yield _as_expected(scene, scene.expected, view, k, measure)
            if lone := _furnace(plan, view, k, tolerance):
                yield replace(lone.agreement, quantity="L_o", where=where)
                continue
            yield _agreement(scene, plan, view, k, tolerance, measure)


def _agreement(
    scene: Scene, plan: ScenePlan, view: Angles, k: int, tolerance: float | None, measure: Measure
) -> MeanClaim:
    """L_o of a channel equals its truth; a quadrature is asked where samples leave that open, and
    another one before one is believed."""
    relative = AGREEMENT_TOLERANCE if tolerance is None else tolerance
    target = max(FINEST, AIM * relative)
    expected = functools.partial(truth.reference, plan.scene, from_degrees(*view), k)

    def afresh(seed: int) -> Reference:
        return expected(truth.Quadrature(1 + seed, target))

    def fallback(seed: int) -> Measurement:
        found = expected(truth.Quadrature(1 + seed, target, alone=True))
        return as_measurement(found.value, found.error)

    known = expected(truth.Quadrature(target=target))
    channel = functools.partial(_channel, measure, k)
    claim = _equal("L_o", place(scene, view, k), known, tolerance, channel)
    return replace(claim, fallback=fallback, afresh=afresh)


def _as_expected(
    scene: Scene, expected: Expected, view: Angles, k: int, measure: Measure
) -> MeanClaim:
    """L_o is what the scene's author says."""
    lone = scene.lobes[0] if len(scene.lobes) == 1 else None
    more = named_values(lone.model, lone.sets[k], 0) if lone else {}
    value = expected.value(k, *view, more)
    said = expected.formulas[k if len(expected.formulas) > 1 else 0]
    return MeanClaim(
        "L_o as expected", place(scene, view, k), Bound.EQUAL,
        Reference(value, 0.0, Kind.DECLARED, f"[expected] {said}"), expected.tolerance(value),
        functools.partial(_channel, measure, k),
    )  # fmt: skip


def _equal(
    quantity: str,
    where: Mapping[str, float],
    expected: Reference,
    tolerance: float | None,
    measure: Measure,
) -> MeanClaim:
    relative = AGREEMENT_TOLERANCE if tolerance is None else tolerance
    width = relative * abs(expected.value)
    return MeanClaim(quantity, where, Bound.EQUAL, expected, width, measure)


def _radiance(scene: Scene, plan: ScenePlan, wo: Vec) -> Measure:
    """L_o of all channels, computed once per number of samples."""
    if isinstance(scene.surface, Standard):
        return functools.partial(_shaded, scene, scene.surface, plan, wo)
    return functools.partial(_remembered, plan, wo)


def _remembered(plan: ScenePlan, wo: Vec, sampling: Plan) -> list[Measurement]:
    """Views that share an evaluation share its estimates."""
    at = (wo, sampling)
    if at not in plan.known:
        plan.known[at] = radiance.measure(plan, wo, sampling)
    found: list[Measurement] = plan.known[at]
    return found


def _shaded(
    scene: Scene, s: Standard, plan: ScenePlan, wo: Vec, sampling: Plan
) -> list[Measurement]:
    """The standard lighting equation as it is written."""
    colour = standard.shade(s, wo, plan.lights, scene.ambient, scene.emission)
    return [Measurement("equation", radiance.combined(c, [])) for c in colour]


def _channel(measure: Measure, k: int, sampling: Plan) -> list[Measurement]:
    return [measure(sampling)[k]]


def energy_claims(
    scene: Scene, plan: ScenePlan, tolerance: float | None, reverse: bool = False
) -> Iterator[MeanClaim]:
    """A <= 1 at every polar angle of the view, or R <= 1 with the light there."""
    angle, quantity = ("theta_i_deg", "R <= 1") if reverse else ("theta_o_deg", "A <= 1")
    for view, measure in _albedos(plan):
        for k in range(scene.channels):
            where = place(scene, view, k, angle)
            if not reverse and (lone := _furnace(plan, view, k, tolerance)):
                yield replace(lone.energy, where=where, unit=_units(scene, k))
                continue
            yield MeanClaim(
                quantity,
                where,
                Bound.AT_MOST,
                Reference(1.0, 0.0, Kind.BOUND, "energy conservation"),
                BOUND_TOLERANCE if tolerance is None else tolerance,
                functools.partial(_channel, measure, k),
                property=Property.ENERGY,
                unit={} if reverse else _units(scene, k),
            )


class Furnace(NamedTuple):
    """What `furnace` asks of a lobe that alone is seen, under nothing but a constant sky."""

    agreement: MeanClaim
    energy: MeanClaim


def _furnace(
    plan: ScenePlan, view: Angles, channel: int, tolerance: float | None
) -> Furnace | None:
    """The same question has one answer: the furnace's claims times the light, where a scene is one;
    None where it is more."""
    scene = plan.scene
    lone = len(plan.works) == len(scene.lobes) == 1 and plan.skip and not plan.lights
    if not lone or any(scene.emission) or any(scene.ambient) or scene.sky is None:
        return None
    (lobe,), factor = scene.lobes, scene.lobes[0].weights[channel] * scene.sky.scales[channel]
    if factor <= 0.0 or not isinstance(scene.sky.shapes[channel], Constant):
        return None
    theta, phi = view[0], plan.views[view][1]  # azimuths that are alike share an evaluation
    at = ("furnace", theta, phi, channel, tolerance)
    if at not in plan.known:
        model, p = lobe.model, lobe.sets[channel]
        case = Case(model, p, [theta], phi, tolerance=tolerance)
        plan.known[at] = Furnace(*(_times(factor, c) for c in furnace.at_angle(case, theta)))
    found: Furnace = plan.known[at]
    return found


def _times(factor: float, claim: MeanClaim) -> MeanClaim:
    """A claim about `factor` times what it is about; a bound stays what it is."""
    if factor == 1.0:
        return claim
    scale = factor if claim.bound is Bound.EQUAL else 1.0
    last, afresh = claim.fallback, claim.afresh
    return replace(
        claim,
        expected=claim.expected and claim.expected.times(scale),
        afresh=(lambda seed: (r := afresh(seed)) and r.times(scale)) if afresh else None,
        tolerance=claim.tolerance * scale,
        measure=lambda plan: [m.times(factor) for m in claim.measure(plan)],
        fallback=(lambda seed: last(seed).times(factor)) if last else None,
    )


def _albedos(plan: ScenePlan) -> Iterator[tuple[Angles, Measure]]:
    """Every polar angle of the view at its first azimuth, and the albedos there."""
    phi = plan.scene.view.phi_o_deg[0]
    for theta in dict.fromkeys(theta for theta, _ in plan.views):
        wo = from_degrees(*plan.views[theta, phi])
        yield (theta, phi), functools.partial(_remembered, plan, wo)


def _units(scene: Scene, channel: int) -> dict[str, float]:
    """What a hint may compare A with: the scale of the only lobe."""
    if len(scene.lobes) != 1 or not scene.lobes[0].model.scales_with:
        return {}
    (lobe,) = scene.lobes
    name = str(lobe.model.scales_with)
    value = float(getattr(lobe.sets[channel], name)) * lobe.weights[channel]
    return {name: value} if value else {}


def band_claims(scene: Scene, plan: ScenePlan, tolerance: float | None) -> Iterator[MeanClaim]:
    """Albedo over the band: int A E dl / int E dl, linear in the albedos at the wavelengths."""
    if scene.band is None:
        return
    shares = scene.band.shares
    for view, measure in _albedos(plan):
        wo = from_degrees(*view)
        rows = [truth.reference(plan.scene, wo, k) for k in range(scene.channels)]
        value = math.fsum(s * r.value for s, r in zip(shares, rows, strict=True))
        error = math.fsum(s * r.error for s, r in zip(shares, rows, strict=True))
        expected = Reference(value, error + 1e-15 * abs(value), rows[0].kind, rows[0].source)
        band = functools.partial(_weighted, measure, shares)
        yield _equal("albedo over the band", {"theta_o_deg": view[0]}, expected, tolerance, band)


def _weighted(measure: Measure, shares: list[float], sampling: Plan) -> list[Measurement]:
    rows = measure(sampling)
    parts = [(s, m.estimate) for s, m in zip(shares, rows, strict=True)]
    unfit = next((m.unfit for m in rows if m.unfit), None)
    return [Measurement(rows[0].estimator, radiance.combined(0.0, parts), unfit)]


def place(scene: Scene, view: Angles, channel: int, angle: str = "theta_o_deg") -> dict[str, float]:
    """Where a finding stands."""
    where: dict[str, float] = {angle: view[0]}
    if len(scene.view.phi_o_deg) > 1 or view[1]:
        where[angle.replace("theta", "phi")] = view[1]
    if scene.band:
        return {**where, "nm": scene.band.wavelengths[channel]}
    return {**where, "channel": channel} if scene.channels > 1 else where


def weight_sums(scene: Scene) -> list[float]:
    """kd + ks per channel; nothing for a single lobe of weight 1."""
    if len(scene.lobes) < 2:
        return []
    return [math.fsum(lobe.weights[c] for lobe in scene.lobes) for c in range(scene.channels)]


def exchanged(wo: Vec, wi: Vec, p: tuple[float, ...]) -> float:
    """f with light and viewer exchanged."""
    return F(wi, wo, p)


def reversed_scene(scene: Scene) -> Scene | None:
    """The scene with light and viewer exchanged, whose albedo is the reverse albedo R; or None.

    R(wi) = int f cos(theta_o) dwo is what energy conservation bounds by 1. It equals A(wi) exactly
    if f is reciprocal: only lobes that are not are exchanged, and None is returned if all are.
    """
    lobes = tuple(lobe if _reciprocal(lobe) else _exchanged(lobe) for lobe in scene.lobes)
    return None if lobes == scene.lobes else replace(scene, surface=Surface(lobes))


def _reciprocal(lobe: Lobe) -> bool:
    """Whether f(wo, wi) = f(wi, wo) at pairs of ordinary directions, in every channel."""
    return not any(lobe.weights) or all(
        math.isclose(
            radiance.value_of(lobe.model, p, wo, wi),
            radiance.value_of(lobe.model, p, wi, wo),
            rel_tol=ROUNDING,
        )
        for p in dict.fromkeys(lobe.sets)
        for wo, wi in PAIRS
    )


def _exchanged(lobe: Lobe) -> Lobe:
    model = lobe.model
    f = _bound(plain(model.f))
    made = replace(model, name=f"{model.name}, exchanged", f=f, built_in=False)
    if model.pdf is None or probe.returns_weight(model):  # a weight is that of f itself
        made = replace(made, sample=None, pdf=None)
    return lobe._replace(name=f"{lobe.name}, exchanged", model=made)


@functools.cache
def _bound(f: Callable[..., float]) -> Callable[..., float]:
    return types.FunctionType(exchanged.__code__, {**globals(), "F": f}, exchanged.__name__)
