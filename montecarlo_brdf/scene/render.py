"""A sphere under the scene's light, shaded per pixel: linear radiance, with its error.

Orthographic camera; under a constant sky an isotropic surface depends on one angle only, so that
the radiance is a table over mu = n.v (`angle_table`, the error is stated). Otherwise every pixel is
its own estimate. A sphere is convex: lights are hidden by the horizon only.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.angle_table import tabulated
from montecarlo_brdf.scene.pixels import means
from montecarlo_brdf.scene.plan import Work, make
from montecarlo_brdf.scene.radiance import ambient_colour
from montecarlo_brdf.scene.scene import Scene, as_lobes
from montecarlo_brdf.scene.surface import Surface
from montecarlo_brdf.scene.texels import Image, cumulated
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

    Reals = NDArray[float64]
    Disk = tuple[Reals, Reals, Reals]  # (n) each: right, up, towards the camera

Progress = Callable[[float], None]


class Sphere(NamedTuple):
    """Linear radiance (size, size, channels), background included."""

    values: Reals
    inside: NDArray[bool_]  # (size, size), which pixels show the sphere
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
    progress: Progress | None = None,
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
    disk: Disk
    camera: Vec
    seed: int
    samples: int
    threads: int

    def placed(self) -> tuple[Reals, Reals]:
        """Normals in the world (n, 3) and the place (n, PLACE) of every pixel."""
        normals = in_world(self.disk, self.camera)
        isotropic = Surface(self.scene.lobes).isotropic
        return normals, places_of(normals, self.camera, _cosines(self.disk), isotropic)

    def reflected(
        self, work: Work, k: int, progress: Progress | None
    ) -> tuple[Reals, float, str]:
        """Radiance (n, sets) of a lobe under the sky, its error, and how it was found."""
        key = stream(self.seed, "render", work.name, k)
        if _one_angle(work):
            return tabulated(work, _cosines(self.disk), self.seed, key, self.threads)
        values, error = means(work, self.placed()[1], self.samples, key, self.threads, progress)
        return values, float(error.max()), f"{self.samples} samples per pixel"


def _cosines(disk: Disk) -> Reals:
    """n.v of every pixel, (n)."""
    import numpy as np

    return np.clip(disk[2], 1e-6, 1.0)


def _part(progress: Progress | None, k: int, n: int) -> Progress | None:
    return (lambda done: progress((k + done) / n)) if progress else None


def _one_angle(work: Work) -> bool:
    """Whether the radiance depends on n.v alone."""
    constant = isinstance(work.sets[0][1], skies.Constant)
    return constant and bool(work.model.isotropic)


def whole_sky(scene: Scene) -> Scene:
    """The scene with a sky that shines from everywhere, also on what a flat surface does not see.

    Raises UserError if the sky is negative below the horizon.
    """
    sky = scene.sky
    if sky is None or sky.black:
        return scene
    least = min(skies.lowest(shape) for shape in sky.shapes)
    if least < -1e-9:
        raise UserError(
            f"negative radiance: below the horizon, where a sphere looks too, the sky falls to "
            f"{least:.3g}"
        )
    images = [shape for shape in sky.shapes if isinstance(shape, Image)]
    if not images:
        return scene
    tables = [cumulated(plane, below=True) for plane in sky.keep[::2]]
    rows = [t for t in tables for _ in range(len(images) // len(tables))]
    shapes = tuple(
        s._replace(table=float(t.ctypes.data)) for s, t in zip(images, rows, strict=True)
    )
    return replace(scene, sky=sky._replace(shapes=shapes, keep=[*sky.keep, *tables]))


def disk_of(size: int) -> tuple[NDArray[bool_], Disk]:
    """Which pixels show the sphere, and (right, up, towards the camera) of its normals there."""
    import numpy as np

    x = (np.arange(size) + 0.5) * (2.2 / size) - 1.1
    x, y = np.meshgrid(x, -x)
    inside = x * x + y * y < 1.0
    x, y = x[inside], y[inside]
    return inside, (x, y, np.sqrt(1.0 - x * x - y * y))


def in_world(disk: Disk, camera: Vec) -> Reals:
    """Normals of the disk's pixels in the world, (n, 3)."""
    import numpy as np

    x, y, z = disk
    right, up = _screen(camera)
    normals: Reals = x[:, None] * right + y[:, None] * up + z[:, None] * np.array(camera)
    return normals


def _screen(camera: Vec) -> tuple[Reals, Reals]:
    """Right and up of the picture: up is the world's z, or y when looking along z."""
    import numpy as np

    pole = (0.0, 1.0, 0.0) if abs(camera[2]) > 0.999999 else (0.0, 0.0, 1.0)
    right = np.cross(pole, camera)
    right /= np.linalg.norm(right)
    return right, np.cross(camera, right)


def places_of(normals: Reals, camera: Vec, mu: Reals, isotropic: bool) -> Reals:
    """View in the frame, tangent, bitangent, normal: (n, PLACE), of normals (n, 3) and n.v (n).

    Tangents of anisotropic surfaces run along latitudes.
    """
    import numpy as np

    view = np.array(camera)
    along = view - mu[:, None] * normals if isotropic else np.cross((0.0, 0.0, 1.0), normals)
    length = np.linalg.norm(along, axis=1, keepdims=True)
    spare = np.cross(normals, (0.0, 1.0, 0.0)) + 1e-12
    along = np.where(length > 1e-9, along / np.maximum(length, 1e-9), spare)
    tangent = along - np.sum(along * normals, axis=1, keepdims=True) * normals
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    bitangent = np.cross(normals, tangent)
    local = np.stack([tangent @ view, bitangent @ view, mu], axis=1)
    return np.concatenate([local, tangent, bitangent, normals], axis=1)


def _ambient(scene: Scene) -> Reals:
    import numpy as np

    return np.array(scene.ambient) * (ambient_colour(scene) if any(scene.ambient) else 0.0)


def _lit(scene: Scene, normals: Reals, places: Reals) -> Reals:
    """Delta lights: f E cos, summed exactly, (n, channels)."""
    import numpy as np

    total = np.zeros((len(normals), scene.channels))
    for light in scene.lights:
        to_light, factor = light.over(normals)
        local = np.stack(
            [np.sum(to_light * places[:, k : k + 3], axis=1) for k in (3, 6, 9)], axis=1
        )
        lit = local[:, 2] > 0.0
        for lobe in scene.lobes:
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
