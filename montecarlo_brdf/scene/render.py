"""A sphere under the scene's light, shaded per pixel: linear radiance, with its error.

Orthographic camera; under a constant sky an isotropic surface depends on one angle only, so that
the radiance is a table over mu = n.v (`angle_table`, the error is stated). Otherwise every pixel is
its own estimate. A sphere is convex: lights are hidden by the horizon only.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from montecarlo_brdf.estimate.pointwise import Pointwise
from montecarlo_brdf.sampling.streams import stream
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.angle_table import tabulated
from montecarlo_brdf.scene.camera import disk_of, in_world, places_of, towards
from montecarlo_brdf.scene.pixels import means
from montecarlo_brdf.scene.plan import Work, make
from montecarlo_brdf.scene.radiance import ambient_colour
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.sphere_sky import whole_sky
from montecarlo_brdf.scene.standard_lobes import as_lobes
from montecarlo_brdf.vectors import Vec


class Sphere(NamedTuple):
    """Linear radiance (size, size, channels), background included."""

    values: Any
    inside: Any  # (size, size), which pixels show the sphere
    error: float  # the largest: standard errors of pixels, bounds of tables with interpolation
    how: str


def render(
    scene: Scene,
    *,
    size: int = 512,
    samples: int = 256,
    seed: int = 0,
    threads: int = 1,
    camera: Vec | None = None,
    progress: Callable[[float], None] | None = None,
) -> Sphere:
    """The picture of a sphere in a scene.

    scene: from `read_scene` or `scene_of`. size: pixels across. samples: per pixel, where pixels
    are sampled. seed: 0 to 2^64 - 1. threads: no result depends on their number. camera: unit
    vector towards the viewer, None for the scene's own. progress: is called with the fraction done.

    Returns a Sphere; its values have the shape (size, size, channels), in the unit of the lights.
    Raises UserError for a sky with negative radiance below the horizon, which a flat surface does
    not see; ModelError if a model fails.
    """
    import numpy as np

    camera = scene.view.camera if camera is None else camera
    scene = whole_sky(as_lobes(scene))
    plan = make(scene, sphere=True)
    inside, disk = disk_of(size)
    total = np.tile(np.array(scene.emission) + _ambient(scene), (len(disk[2]), 1))
    wrong = np.zeros(scene.channels)
    hows = []
    points = _Points(scene, disk, camera, seed, samples, threads)
    for k, work in enumerate(plan.works):
        values, error, how = points.reflected(work, k, _part(progress, k, len(plan.works)))
        hows.append(how)
        for c, part in enumerate(work.shares):
            if part is not None:
                total[:, c] += part.factor * values[:, part.place]
                wrong[c] += abs(part.factor) * error
    if scene.lights:
        total += _lit(scene, *points.placed())
    picture = np.empty((size, size, scene.channels))
    picture[:] = _background(scene, camera)
    picture[inside] = total
    how = ", ".join(dict.fromkeys(hows)) or "exact sum of lights"
    return Sphere(picture, inside, float(np.max(wrong)), how)


class _Points(NamedTuple):
    """The sphere's pixels and how they are sampled."""

    scene: Scene
    disk: Any
    camera: Vec
    seed: int
    samples: int
    threads: int

    def placed(self) -> tuple[Any, Any]:
        """Normals in the world and the frame of every pixel."""
        normals = in_world(self.disk, self.camera)
        isotropic = self.scene.surface.isotropic  # type: ignore[union-attr]
        return normals, places_of(normals, self.camera, _cosines(self.disk), isotropic)

    def reflected(self, work: Work, k: int, progress: Any) -> tuple[Any, float, str]:
        """Radiance (n, sets) of a lobe under the sky, its error, and how it was found."""
        key = stream(self.seed, "render", work.name, k)
        if _one_angle(work):
            return tabulated(work, _cosines(self.disk), self.seed, key, self.threads)
        values, error = means(work, self.placed()[1], self.samples, key, self.threads, progress)
        return values, float(error.max()), f"{self.samples} samples per pixel"


def _cosines(disk: Any) -> Any:
    """n.v of every pixel."""
    import numpy as np

    return np.clip(disk[2], 1e-6, 1.0)


def _part(progress: Callable[[float], None] | None, k: int, n: int) -> Any:
    return (lambda done: progress((k + done) / n)) if progress else None


def _one_angle(work: Work) -> bool:
    """Whether the radiance depends on n.v alone."""
    constant = isinstance(work.sets[0][1], skies.Constant)
    return constant and bool(work.model.isotropic)


def _ambient(scene: Scene) -> Any:
    import numpy as np

    return np.array(scene.ambient) * (ambient_colour(scene) if any(scene.ambient) else 0.0)


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
