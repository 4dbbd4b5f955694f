"""What the reflected radiance must be: closed forms where there are any, else quadrature.

Nothing here is shared with the estimators: skies are integrated by `references`, delta lights are
summed over values of f that were compiled (the estimates use the plain functions), and quadrature
has its own charts. A quadrature takes f as it is, so it can refute samplers and sums, not f.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.checks._truth import TARGET, probes
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.judge.claim import Kind, Reference
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.scene import ORIGIN, Scene
from montecarlo_brdf.scene.surface import ignores_directions
from montecarlo_brdf.scene.texels import Image
from montecarlo_brdf.truth import true_albedo
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from montecarlo_brdf.estimate.quadrature import Integral
    from montecarlo_brdf.estimate.regions import Chart

    Array = NDArray[np.float64]
    OfArray = Callable[[Array], Array]

#: the last of several kinds is that of their sum
ORDER = (Kind.CLOSED_FORM, Kind.DECLARED, Kind.INDEPENDENT, Kind.SAME_F)


class Quadrature(NamedTuple):
    """How f is integrated where that is asked for."""

    seed: int = 0  # another one is another quadrature
    target: float = TARGET  # relative error
    alone: bool = False  # also where a closed form is known


USUAL = Quadrature()

def reference(
    scene: Scene, wo: Vec, channel: int, how: Quadrature = USUAL
) -> Reference:
    """The expected L_o of one channel."""
    parts = [Reference(scene.emission[channel], 0.0, Kind.CLOSED_FORM, "emission")]
    for lobe in scene.surface.lobes:  # type: ignore[union-attr]
        weight, p = lobe.weights[channel], lobe.sets[channel]
        if weight == 0.0:
            continue
        found = [direct(scene, lobe.model, p, wo, channel)]
        if scene.sky is not None and scene.sky.scales[channel]:
            under = _under(scene.sky, lobe.model, p, wo, channel, how)
            found.append(under.times(scene.sky.scales[channel]))
        if ignores_directions(lobe.model):
            albedo = constant_f(lobe.model, p, math.pi).times(scene.ambient[channel])
            found.append(albedo._replace(source="ambient"))
        parts += [r.times(weight) for r in found]
    return _sum([r for r in parts if r.value != 0.0 or r.error != 0.0] or parts[:1])


def _sum(parts: list[Reference]) -> Reference:
    kind = max((p.kind for p in parts), key=ORDER.index)
    value = math.fsum(p.value for p in parts)
    error = math.fsum(p.error for p in parts) + 4e-16 * math.fsum(abs(p.value) for p in parts)
    return Reference(value, error, kind, " + ".join(dict.fromkeys(p.source for p in parts)))


def direct(scene: Scene, model: Model, p: ParameterSet, wo: Vec, channel: int) -> Reference:
    """The exact sum over delta lights."""
    placed = [(*light.at(ORIGIN), light.colour[channel]) for light in scene.lights]
    lit = [(w, factor * e) for w, factor, e in placed if w[2] > 0.0 and e]
    if not lit:
        return Reference(0.0, 0.0, Kind.CLOSED_FORM, "no light")
    if ignores_directions(model):
        irradiance = math.fsum(e * w[2] for w, e in lit)
        return constant_f(model, p, irradiance)._replace(source="exact sum of lights")
    values = Pointwise(model, p).f(wo, [w for w, _ in lit])
    terms = [f * e * w[2] for f, (w, e) in zip(map(float, values), lit, strict=True)]
    # plain and compiled f differ by the rounding of powers with large exponents
    error = 1e-12 * math.fsum(map(abs, terms))
    return Reference(math.fsum(terms), error, Kind.SAME_F, "exact sum of lights")


def constant_f(model: Model, p: ParameterSet, irradiance: float) -> Reference:
    """f E for an f that ignores directions."""
    up = (0.0, 0.0, 1.0)
    value = float(model.f(up, up, model.prepared(p))) * irradiance
    return Reference(value, 4e-15 * abs(value), Kind.CLOSED_FORM, "f E")


def _under(
    sky: skies.Sky, model: Model, p: ParameterSet, wo: Vec, channel: int, how: Quadrature
) -> Reference:
    shape = sky.shapes[channel]
    if ignores_directions(model) and not how.alone:
        found = constant_f(model, p, irradiance(sky, channel))
        # the area of a cap at the horizon is a difference of terms as large as its sine
        terms = (
            math.sqrt(shape.depth * (2.0 - shape.depth)) if isinstance(shape, skies.Cap) else 0.0
        )
        error = found.error + constant_f(model, p, 1e-15 * terms).value
        return found._replace(error=error, source=f"E under {type(shape).__name__} times f")
    return _of_shape(model, p, shape, wo, how)


def irradiance(sky: skies.Sky, channel: int) -> float:
    """E of the unit shape, closed form for every sky."""
    shape = sky.shapes[channel]
    axis = skies.axis_of(shape)
    if isinstance(shape, skies.Linear):
        return _irradiance.linear(shape.a, shape.b, axis[2])
    if isinstance(shape, skies.Quadratic):
        return _irradiance.quadratic(axis[2])
    if isinstance(shape, skies.Cosine):
        return _irradiance.cosine(shape.exponent, axis[2])
    if isinstance(shape, skies.Cap):
        gamma = 2.0 * math.asin(math.sqrt(min(1.0, 0.5 * shape.depth)))
        return _irradiance.cap(gamma, math.atan2(math.hypot(axis[0], axis[1]), axis[2]))
    if isinstance(shape, skies.Harmonics):
        return _irradiance.harmonics(shape.coefficients)
    if isinstance(shape, Image):
        plane = sky.keep[2 * (channel if len(sky.keep) > 2 else 0)]
        return _irradiance.image([float(v) for v in plane.sum(axis=1)], plane.shape[1])
    return _irradiance.constant()


@functools.lru_cache(maxsize=4096)
def _of_shape(
    model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec, how: Quadrature
) -> Reference:
    """A lobe under a sky of unit scale."""
    known = None if how.alone else _known(model, p, shape, wo)
    if known is not None:
        return known
    value, error = _quadrature(model, p, shape, wo, how)
    return Reference(value, error, Kind.SAME_F, "adaptive quadrature")


def _known(model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec) -> Reference | None:
    """A truth that is no quadrature of f."""
    if not model.built_in:
        return None
    truth = None
    if isinstance(shape, skies.Constant):
        truth = _albedo(model, p, wo)
    elif isinstance(shape, skies.Cosine) and shape.axis == (0.0, 0.0, 1.0):
        truth = _irradiance.cosine_sky(model.name, wo[2], shape.exponent, **p._asdict())
    return Reference.of(*truth) if truth else None


def _albedo(model: Model, p: ParameterSet, wo: Vec) -> Any:
    turned = {} if model.isotropic else {"phi_o": math.atan2(wo[1], wo[0])}
    return true_albedo(model.name, wo[2], **p._asdict(), **model.picks, **turned)


def _quadrature(
    model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec, how: Quadrature
) -> Integral:
    from montecarlo_brdf.estimate.quadrature import integrate, star

    f, sky = Pointwise(model, p).f, _array_sky(shape)
    seen = probes(model, p, wo, seed=how.seed)
    if skies.concentrated(shape):
        seen = (*seen, star(_brightest(skies.axis_of(shape))))
    return integrate(
        lambda w: f(wo, w) * sky(w) * w[:, 2], _chart(shape, wo), how.target, seen, how.seed
    )


def _chart(shape: skies.Shape, wo: Vec) -> Chart:
    """Coordinates of the directions from which light comes."""
    from montecarlo_brdf.estimate import regions

    if isinstance(shape, skies.Cap):
        return regions.Around(shape.axis, 2.0 * math.asin(math.sqrt(min(1.0, 0.5 * shape.depth))))
    if isinstance(shape, Image):
        return regions.Texels(int(shape.height), int(shape.width))
    return regions.Coordinates(wo)


def _brightest(axis: Vec) -> Vec:
    """The direction nearest to an axis that is not below the horizon."""
    if axis[2] >= 0.0:
        return axis
    sine = math.hypot(axis[0], axis[1])
    return (axis[0] / sine, axis[1] / sine, 0.0) if sine > 0.0 else (1.0, 0.0, 0.0)


def _array_sky(shape: skies.Shape) -> OfArray:
    """L on an array of directions (n, 3)."""
    import numpy as np

    if isinstance(shape, skies.Cosine):
        return lambda w: np.maximum(0.0, w @ np.array(shape.axis)) ** shape.exponent
    if isinstance(shape, (skies.Cap, skies.Constant)):
        return lambda w: np.ones(len(w))  # the chart ends where the cap does
    if isinstance(shape, Image):
        return functools.partial(_texels, _texel_values(shape))
    function: Callable[..., Any] = skies.FUNCTIONS[type(shape)].radiance  # of arrays too
    return lambda w: function(tuple(w.T), shape)


def _texels(values: Array, w: Array) -> Array:
    """Of constant texels, zenith first, azimuth from -pi."""
    import numpy as np

    height, width = values.shape
    angle = np.arctan2(np.hypot(w[:, 0], w[:, 1]), w[:, 2])
    turn = np.arctan2(w[:, 1], w[:, 0])
    row = np.minimum((angle * (height / np.pi)).astype(int), height - 1)
    column = np.minimum(((turn + np.pi) * (width / (2.0 * np.pi))).astype(int), width - 1)
    found: Array = values[row, column]
    return found


def _texel_values(shape: Image) -> Array:
    import ctypes

    import numpy as np

    size = int(shape.width * shape.height)
    memory = (ctypes.c_double * size).from_address(int(shape.address))
    return np.ctypeslib.as_array(memory).reshape(int(shape.height), int(shape.width))
