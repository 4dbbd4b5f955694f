"""What a scene needs to be evaluated, before anything is: the rest is skipped, with the reason.

Skipping is exact: what is left out is zero, equal to something that is evaluated, or a multiple of
it. `skip=False` gives the long way, every lobe, channel, light and view for itself.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.model import Model
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.colour import Colour
from montecarlo_brdf.scene.scene import ORIGIN, Scene, as_lobes
from montecarlo_brdf.scene.skies import Shape, Sky
from montecarlo_brdf.scene.surface import Lobe, Parameters, Surface, ignores_directions
from montecarlo_brdf.vectors import Vec

Angles = tuple[float, float]  # theta, phi in degrees
WIDE = 0.1  # share of a cap's solid angle that a lobe must fill to be sampled by the cap alone


class Method(StrEnum):
    """How a lobe is evaluated: at one value, or by samples of directions from one source or two."""

    ONE_VALUE = "one value"
    COSINE = "cosine"
    SKY = "sky"
    OWN = "own"
    MIXED = "mixed"


class Item(NamedTuple):
    """One line of --explain."""

    what: str
    evaluated: bool
    reason: str
    estimates: int = 0  # per view, that are run or saved


class Share(NamedTuple):
    """A channel's part of a work: factor times the estimate of a set."""

    place: int
    factor: float


class Work(NamedTuple):
    """One lobe under the sky: distinct parameter sets, and what every channel takes of them."""

    name: str
    model: Model
    sets: tuple[tuple[Parameters, Shape], ...]
    shares: tuple[Share | None, ...]  # per channel
    method: Method


class ScenePlan(NamedTuple):
    """All that is evaluated."""

    scene: Scene
    works: list[Work]
    lights: list[tuple[Vec, Colour]]  # direction, irradiance across the beam
    lobes: list[Lobe]  # that lights are reflected by
    views: dict[Angles, Angles]  # every view, and the one that is evaluated for it
    items: list[Item]
    skip: bool
    known: dict[tuple[object, ...], Any]  # what was measured, by view and sampling


def make(scene: Scene, skip: bool = True, sphere: bool = False) -> ScenePlan:
    """The plan of a scene; of the standard lighting equation, that of its lobes.

    skip: leave out what the scene does not need. sphere: the surface is all of a sphere, which sees
    more of the sky than a flat one.
    """
    items: list[Item] = []
    whole = as_lobes(scene)
    lobes = _lobes(whole, skip, items)
    works = _works(whole, lobes, skip, sphere, items)
    lights = _lights(whole, skip, items)
    # the standard equation's ambient light is part of what its lobes emit
    for name, colour in (("ambient", scene.ambient), ("emission", whole.emission)):
        if skip and not any(colour):
            items.append(Item(name, False, "it is zero"))
    return ScenePlan(whole, works, lights, lobes, _views(whole, skip, items), items, skip, {})


def _lobes(scene: Scene, skip: bool, items: list[Item]) -> list[Lobe]:
    kept = []
    for lobe in scene.lobes:
        if skip and not any(lobe.weights):
            items.append(Item(f"lobe {lobe.name}", False, "its weight is zero", scene.channels))
        else:
            kept.append(lobe)
    return kept


def _works(
    scene: Scene, lobes: list[Lobe], skip: bool, sphere: bool, items: list[Item]
) -> list[Work]:
    sky = scene.sky
    if sky is None:
        return []
    if skip and (sky.black or (not sphere and all(map(skies.below_horizon, sky.shapes)))):
        reason = "it is black" if sky.black else "all of it is below the horizon"
        items.append(Item("environment", False, reason, len(lobes) * scene.channels))
        return []
    if not skip:
        return [_alone(lobe, sky, c) for lobe in lobes for c in range(scene.channels)]
    return [work for lobe in lobes if (work := _shared(lobe, sky, items))]


def _alone(lobe: Lobe, sky: Sky, c: int) -> Work:
    """One channel of a lobe the long way: hemisphere sampling, whatever the factor."""
    count = len(lobe.weights)
    share = Share(0, lobe.weights[c] * sky.scales[c])
    shares = tuple(share if k == c else None for k in range(count))
    method = Method.OWN if lobe.model.sample else Method.COSINE
    return Work(lobe.name, lobe.model, ((lobe.sets[c], sky.shapes[c]),), shares, method)


def _shared(lobe: Lobe, sky: Sky, items: list[Item]) -> Work | None:
    """A lobe with its distinct parameter sets; equal and proportional channels share one."""
    sets: list[tuple[Parameters, Shape]] = []
    shares: list[Share | None] = []
    for weight, p, shape, scale in zip(
        lobe.weights, lobe.sets, sky.shapes, sky.scales, strict=True
    ):
        unit, factor = unscaled(lobe.model, p)
        factor *= weight * scale
        if factor == 0.0:
            shares.append(None)
            continue
        if (unit, shape) not in sets:
            sets.append((unit, shape))
        shares.append(Share(sets.index((unit, shape)), factor))
    if not sets:
        items.append(Item(f"lobe {lobe.name}", False, "it reflects nothing", len(shares)))
        return None
    work = Work(lobe.name, lobe.model, tuple(sets), tuple(shares), _method(lobe.model, *sets[0]))
    _explain(work, items)
    return work


def unscaled(model: Model, p: Parameters) -> tuple[Parameters, float]:
    """The parameter set with its scale taken out, and the scale: f is proportional to it."""
    name = model.scales_with
    if not name:
        return p, 1.0
    return p._replace(**{name: 1.0}), float(getattr(p, name))


def _method(model: Model, p: Parameters, shape: Shape) -> Method:
    """The sampler for a lobe under a sky: the cheapest that sees both."""
    if ignores_directions(model):
        constant = isinstance(shape, skies.Constant)
        spread = Method.SKY if skies.concentrated(shape) else Method.COSINE
        return Method.ONE_VALUE if constant else spread
    if isinstance(shape, skies.Cap) and _covers(model, p, shape):
        return Method.SKY  # no sample meets the cap's edge, where the mixture's integrand jumps
    if skies.concentrated(shape):
        return Method.MIXED if model.sample and model.pdf else Method.SKY
    return Method.OWN if model.sample else Method.COSINE


def _covers(model: Model, p: Parameters, shape: skies.Cap) -> bool:
    """Whether a lobe is wide enough for uniform samples of a cap to see all of it."""
    if model.lobe is None:
        return True
    width = 2.0 * float(model.lobe[1](p))  # half vectors turn half as fast as directions
    return width * width > WIDE * shape.depth


def _explain(work: Work, items: list[Item]) -> None:
    name = f"lobe {work.name}"
    dark = work.shares.count(None)
    equal = len(work.shares) - dark - len(work.sets)
    if dark:
        items.append(Item(f"{name}, {dark} channels", False, "black", dark))
    if equal:
        reason = "equal to another channel, or a multiple of it"
        items.append(Item(f"{name}, {equal} channels", False, reason, equal))
    if work.method is Method.ONE_VALUE:
        items.append(Item(name, False, "the integrand is constant: one evaluation", len(work.sets)))
        return
    shape = work.sets[0][1]
    share = skies.visible_share(shape)
    if share < 1.0 and work.method is Method.SKY:
        reason = f"only the {share:.2g} of the hemisphere that the cap covers is sampled"
        items.append(Item("directions beyond the cap", False, reason))
    items.append(
        Item(name, True, f"{work.method} sampling, {len(work.sets)} parameter sets", len(work.sets))
    )


def _lights(scene: Scene, skip: bool, items: list[Item]) -> list[tuple[Vec, Colour]]:
    """Directions and irradiances at the origin."""
    found = []
    black = below = 0
    for light in scene.lights:
        if skip and not any(light.colour):
            black += 1
            continue
        wi, factor = light.at(ORIGIN)
        if skip and wi[2] <= 0.0:
            below += 1
            continue
        found.append((wi, tuple(factor * c for c in light.colour)))
    for count, reason in ((black, "black"), (below, "below the horizon")):
        if count:
            items.append(Item(f"{count} lights", False, reason))
    if found:
        lights = "1 light" if len(found) == 1 else f"{len(found)} lights"
        items.append(Item(lights, True, "exact sum, no samples"))
    return found


def _views(scene: Scene, skip: bool, items: list[Item]) -> dict[Angles, Angles]:
    """Views that must give the same radiance are evaluated once."""
    views = [(t, p) for t in scene.view.theta_o_deg for p in scene.view.phi_o_deg]
    found = {v: v for v in views}
    if not skip:
        return found
    surface, why = Surface(scene.lobes), "equal by symmetry"
    turned = scene.sky is None or all(map(skies.symmetric, scene.sky.shapes))
    if surface.constant:
        found, why = dict.fromkeys(views, views[0]), "the surface looks the same from everywhere"
    elif turned and surface.isotropic and not scene.lights:
        found = {(t, p): (t, views[0][1]) for t, p in views}
    saved = len(views) - len(set(found.values()))
    if saved:
        items.append(Item(f"{saved} views", False, why))
    return found
