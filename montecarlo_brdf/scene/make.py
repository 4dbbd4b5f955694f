"""A scene without a file: one model under one sky."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.integration.estimators import check_theta
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.scene.scene import Scene, View
from montecarlo_brdf.scene.sky_tables import short_sky
from montecarlo_brdf.scene.surface import Surface, lobes_of


def scene_of(
    model: Model, p: Any, environment: str, theta_o_deg: Sequence[float] = View().theta_o_deg
) -> Scene:
    """`model` with parameters `p` (colours allowed) under "constant:1", "cosine:8", "cap:10:60"..."""
    sky = short_sky(environment)
    widths = {len(channels(p)), sky.channels} - {1}
    if len(widths) > 1:
        raise UserError(f"the model has {len(channels(p))} channels and the environment {sky.channels}")
    count = widths.pop() if widths else 1
    surface = Surface(tuple(lobes_of(model, p, (1.0,) * count, count)))
    dark = (0.0,) * count
    name = f"{model.name} under {environment}"
    scene = Scene(name, count, surface, sky.spread(count), ambient=dark, emission=dark)
    return with_views(scene, theta_o_deg)


def with_views(scene: Scene, theta_o_deg: Sequence[float]) -> Scene:
    """The scene seen from other polar angles."""
    angles = tuple(check_theta(t) for t in theta_o_deg)
    return replace(scene, view=View(angles, scene.view.phi_o_deg))
