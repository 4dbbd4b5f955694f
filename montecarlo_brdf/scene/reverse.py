"""A surface with light and viewer exchanged: its albedo is the reverse albedo R of the surface.

R(wi) = int f cos(theta_o) dwo is what energy conservation bounds by 1. It equals A(wi) exactly if f
is reciprocal, so only lobes that are not are exchanged.
"""

from __future__ import annotations

import functools
import itertools
import math
import types
from dataclasses import replace
from typing import Any

from montecarlo_brdf.compile.bind import plain
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.scene.radiance import value_of
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.vectors import Vec, from_degrees

F: Any = None
ROUNDING = 1e-9  # relative: f of large exponents in two orders of evaluation
PAIRS = tuple(
    itertools.combinations([from_degrees(11.0 + 15.0 * k, 67.0 * k) for k in range(6)], 2)
)


def exchanged(wo: Vec, wi: Vec, p: Any) -> float:
    """f with light and viewer exchanged."""
    return F(wi, wo, p)


def reversed_scene(scene: Scene) -> Scene | None:
    """The scene with every lobe exchanged that is not reciprocal; None if all are."""
    surface: Any = scene.surface
    lobes = tuple(lobe if _reciprocal(lobe) else _exchanged(lobe) for lobe in surface.lobes)
    return None if lobes == surface.lobes else replace(scene, surface=Surface(lobes))


def _reciprocal(lobe: Lobe) -> bool:
    """Whether f(wo, wi) = f(wi, wo) at pairs of ordinary directions, in every channel."""
    return not any(lobe.weights) or all(
        math.isclose(
            value_of(lobe.model, p, wo, wi), value_of(lobe.model, p, wi, wo), rel_tol=ROUNDING
        )
        for p in dict.fromkeys(lobe.sets)
        for wo, wi in PAIRS
    )


def _exchanged(lobe: Lobe) -> Lobe:
    model = lobe.model
    weighted = model.pdf is None or probe.returns_weight(model)  # a weight is that of f itself
    sampler: dict[str, Any] = {"sample": None, "pdf": None} if weighted else {}
    name = f"{model.name}, exchanged"
    made = replace(model, name=name, f=_bound(plain(model.f)), built_in=False, **sampler)
    return lobe._replace(name=f"{lobe.name}, exchanged", model=made)


@functools.cache
def _bound(f: Any) -> Any:
    return types.FunctionType(exchanged.__code__, {**globals(), "F": f}, exchanged.__name__)
