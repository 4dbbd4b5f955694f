"""The sky as a sphere sees it: all of it, also what is below the horizon of a flat surface."""

from __future__ import annotations

from dataclasses import replace

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.image_sky import cumulated
from montecarlo_brdf.scene.scene import Scene


def whole_sky(scene: Scene) -> Scene:
    """The scene with a sky that shines from everywhere, or a UserError if that is negative."""
    sky = scene.sky
    if sky is None or sky.black:
        return scene
    least = min(skies.lowest(shape) for shape in sky.shapes)
    if least < -1e-9:
        raise UserError(
            f"negative radiance: below the horizon, where a sphere looks too, the sky falls to "
            f"{least:.3g}"
        )
    if not isinstance(sky.shapes[0], skies.Image):
        return scene
    tables = [cumulated(plane, below=True) for plane in sky.keep[::2]]
    rows = [t for t in tables for _ in range(len(sky.shapes) // len(tables))]
    shapes = tuple(
        s._replace(table=float(t.ctypes.data)) for s, t in zip(sky.shapes, rows, strict=True)
    )
    return replace(scene, sky=sky._replace(shapes=shapes, keep=[*sky.keep, *tables]))
