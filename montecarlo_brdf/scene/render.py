"""A sphere under the scene's light, shaded per pixel: linear radiance, with its error.

Orthographic camera; under a constant sky an isotropic surface depends on one angle only, so that
the radiance is tabulated over mu = n.v and interpolated (the error of that is stated). Otherwise
every pixel is its own estimate. A sphere is convex: lights are hidden by the horizon only.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from montecarlo_brdf.integration.pointwise import Pointwise
from montecarlo_brdf.sampling.streams import stream
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.camera import normals_of, places_of, towards
from montecarlo_brdf.scene.claims import as_lobes
from montecarlo_brdf.scene.pixels import means
from montecarlo_brdf.scene.plan import Work, make
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.vectors import Vec

NODES = 64  # intervals of the table over mu
FEWEST_SAMPLES, MOST_SAMPLES = 1 << 14, 1 << 20  # per node of the table
ENOUGH = 2e-5  # relative to a light of 1


class Sphere(NamedTuple):
    """Linear radiance (size, size, channels), background included."""

    values: Any
    inside: Any  # (size, size), which pixels show the sphere
    error: float  # largest standard error of a pixel, or of the table with its interpolation
    how: str


def render(
    scene: Scene,
    *,
    size: int = 512,
    samples: int = 256,
    seed: int = 0,
    threads: int = 1,
    camera: Vec = (0.0, 0.0, 1.0),
    progress: Callable[[float], None] | None = None,
) -> Sphere:
    """The sphere of a scene, `samples` per pixel where pixels are sampled."""
    import numpy as np

    scene = as_lobes(scene)
    plan = make(scene)
    inside, normals = normals_of(size, camera)
    mu = np.clip(normals @ np.array(camera), 1e-6, 1.0)
    simple = not scene.lights and all(_one_angle(w) for w in plan.works)
    places = None if simple else places_of(normals, camera, mu, scene.surface.isotropic)  # type: ignore[union-attr]
    total = np.tile(np.array(scene.emission), (len(normals), 1))
    total += np.array(_ambient(scene))
    error, how = 0.0, "exact sum of lights"
    for k, work in enumerate(plan.works):
        share = _part(progress, k, len(plan.works))
        key = stream(seed, "render", work.name, k)
        if _one_angle(work):
            values, wrong = _tabulated(work, mu, key, threads)
            how = f"table of {2 * NODES + 1} angles"
        else:
            values, wrong = means(work, places, samples, key, threads, share)
            how = f"{samples} samples per pixel"
        for c, part in enumerate(work.shares):
            if part is not None:
                total[:, c] += part.factor * values[:, part.place]
                error = max(error, abs(part.factor) * float(np.max(wrong)))
    if scene.lights:
        total += _lit(scene, normals, places)
    picture = np.empty((size, size, scene.channels))
    picture[:] = _background(scene, camera)
    picture[inside] = total
    return Sphere(picture, inside, error, how)


def _part(progress: Callable[[float], None] | None, k: int, n: int) -> Any:
    return (lambda done: progress((k + done) / n)) if progress else None


def _one_angle(work: Work) -> bool:
    """Whether the radiance depends on n.v alone."""
    constant = isinstance(work.sets[0][1], skies.Constant)
    return constant and bool(work.model.isotropic)


def _tabulated(work: Work, mu: Any, key: int, threads: int) -> tuple[Any, float]:
    """Interpolated radiance, with samples added until that no longer makes the table more exact.

    Nodes are even in sqrt(mu), for what happens towards the limb. The error stated is that of a
    table of half as many nodes at the nodes it leaves out: more than that of the table used.
    """
    import numpy as np

    low = float(np.sqrt(np.min(mu)))
    cosine = np.linspace(low, 1.0, 2 * NODES + 1) ** 2
    places = np.zeros((len(cosine), 12))
    places[:, 0], places[:, 2] = np.sqrt(1.0 - cosine * cosine), cosine
    places[:, 3] = places[:, 7] = places[:, 11] = 1.0
    samples, error, before = FEWEST_SAMPLES // 8, np.inf, np.inf
    while error > ENOUGH and samples < MOST_SAMPLES and (before == np.inf or error < 0.7 * before):
        samples, before = 8 * samples, error
        values, noise = means(work, places, samples, key, threads)
        if float(np.max(noise)) == 0.0:
            error = 0.0
        else:
            odd = np.arange(1, 2 * NODES, 2) / (2.0 * NODES)
            error = float(np.max(np.abs(_cubic(values[::2], odd) - values[1::2])))
    return _cubic(values, (np.sqrt(mu) - low) / (1.0 - low)), error


def _cubic(values: Any, t: Any) -> Any:
    """Values on an even grid of [0, 1] interpolated at t through the four nearest nodes."""
    import numpy as np

    x = np.clip(t, 0.0, 1.0) * (len(values) - 1)
    first = np.clip(np.floor(x).astype(int) - 1, 0, len(values) - 4)
    x = (x - first)[:, None]
    weights = (
        (x - 1.0) * (x - 2.0) * (x - 3.0) / -6.0,
        x * (x - 2.0) * (x - 3.0) / 2.0,
        x * (x - 1.0) * (x - 3.0) / -2.0,
        x * (x - 1.0) * (x - 2.0) / 6.0,
    )
    return sum(w * values[first + k] for k, w in enumerate(weights))


def _ambient(scene: Scene) -> list[float]:
    from montecarlo_brdf.scene.radiance import ambient_colour

    if not any(scene.ambient):
        return [0.0] * scene.channels
    return [a * k for a, k in zip(scene.ambient, ambient_colour(scene), strict=True)]


def _lit(scene: Scene, normals: Any, places: Any) -> Any:
    """Delta lights: f E cos, summed exactly."""
    import numpy as np

    total = np.zeros((len(normals), scene.channels))
    for light in scene.lights:
        to_light, factor = towards(light, normals)
        local = np.stack(
            [np.sum(to_light * places[:, k : k + 3], axis=1) for k in (3, 6, 9)], axis=1
        )
        lit = local[:, 2] > 0.0
        for lobe in scene.surface.lobes:  # type: ignore[union-attr]
            for c, (weight, p) in enumerate(zip(lobe.weights, lobe.sets, strict=True)):
                if weight * light.colour[c]:
                    f = Pointwise(lobe.model, p).f(places[lit, :3], local[lit])
                    total[lit, c] += weight * light.colour[c] * factor[lit] * f * local[lit, 2]
    return total


def _background(scene: Scene, camera: Vec) -> list[float]:
    """What the camera sees beside the sphere: the sky behind it."""
    if scene.sky is None:
        return [0.0] * scene.channels
    behind = (-camera[0], -camera[1], -camera[2])
    radiance = scene.sky.functions.radiance
    rows = zip(scene.sky.shapes, scene.sky.scales, strict=True)
    return [scale * radiance(behind, shape) for shape, scale in rows]
