"""What the reflected radiance must be: closed forms where there are any, else quadrature.

Nothing here is shared with the estimators: skies are integrated by `references`, delta lights are
summed over values of f that were compiled (the estimates use the plain functions), and quadrature
has its own charts. A quadrature takes f as it is, so it can refute samplers and sums, not f.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.judge.claim import Kind, Reference
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.scene import ORIGIN, Scene
from montecarlo_brdf.scene.surface import ignores_directions
from montecarlo_brdf.scene.texels import Image
from montecarlo_brdf.truth import true_albedo
from montecarlo_brdf.vectors import Vec, mirrored

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    OfArray = Callable[[Array], Array]

UNKNOWN = 0.002  # width of a lobe that a model does not tell: looked for, never relied on
#: the last of several kinds is that of their sum
ORDER = (Kind.CLOSED_FORM, Kind.DECLARED, Kind.INDEPENDENT, Kind.SAME_F)


def reference(scene: Scene, wo: Vec, channel: int) -> Reference:
    """The expected L_o of one channel."""
    parts = [Reference(scene.emission[channel], 0.0, Kind.CLOSED_FORM, "emission")]
    for lobe in scene.surface.lobes:  # type: ignore[union-attr]
        weight, p = lobe.weights[channel], lobe.sets[channel]
        if weight == 0.0:
            continue
        found = [direct(scene, lobe.model, p, wo, channel)]
        if scene.sky is not None and scene.sky.scales[channel]:
            under = _under(scene.sky, lobe.model, p, wo, channel)
            found.append(_scaled(under, scene.sky.scales[channel]))
        if ignores_directions(lobe.model):
            albedo = _scaled(constant_f(lobe.model, p, math.pi), scene.ambient[channel])
            found.append(albedo._replace(source="ambient"))
        parts += [_scaled(r, weight) for r in found]
    return _sum([r for r in parts if r.value != 0.0 or r.error != 0.0] or parts[:1])


def _scaled(r: Reference, factor: float) -> Reference:
    return r._replace(value=factor * r.value, error=abs(factor) * r.error)


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


def _under(sky: skies.Sky, model: Model, p: ParameterSet, wo: Vec, channel: int) -> Reference:
    shape = sky.shapes[channel]
    if ignores_directions(model):
        found = constant_f(model, p, irradiance(sky, channel))
        # the area of a cap at the horizon is a difference of terms as large as its sine
        terms = (
            math.sqrt(shape.depth * (2.0 - shape.depth)) if isinstance(shape, skies.Cap) else 0.0
        )
        error = found.error + constant_f(model, p, 1e-15 * terms).value
        return found._replace(error=error, source=f"E under {type(shape).__name__} times f")
    return _of_shape(model, p, shape, wo)


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
def _of_shape(model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec) -> Reference:
    """A lobe under a sky of unit scale."""
    known = _closed(model, p, shape, wo)
    if known is not None:
        return known
    if isinstance(shape, skies.Constant) and model.built_in:
        truth = _albedo(model, p, wo)
        if truth:
            return Reference(*truth)
    value, error = _quadrature(model, p, shape, wo)
    return Reference(value, error, Kind.SAME_F, "adaptive quadrature")


def _albedo(model: Model, p: ParameterSet, wo: Vec) -> Any:
    turned = {} if model.isotropic else {"phi_o": math.atan2(wo[1], wo[0])}
    return true_albedo(model.name, wo[2], **p._asdict(), **model.picks, **turned)


def _closed(model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec) -> Reference | None:
    if isinstance(shape, skies.Cosine) and shape.axis == (0.0, 0.0, 1.0) and model.built_in:
        truth = _irradiance.cosine_sky(model.name, wo[2], shape.exponent, **p._asdict())
        return Reference.of(*truth) if truth else None
    return None


def _quadrature(model: Model, p: ParameterSet, shape: skies.Shape, wo: Vec) -> tuple[float, float]:
    import numpy as np

    from montecarlo_brdf.checks import _truth
    from montecarlo_brdf.estimate.quadrature import integrate
    from montecarlo_brdf.references import _sky

    at = Pointwise(model, p)
    sky = _array_sky(shape)

    def g(wi: Array) -> Array:
        return at.f(wo, wi) * sky(wi)

    kind, width = (model.lobe[0], float(model.lobe[1](p))) if model.lobe else (None, UNKNOWN)
    if isinstance(shape, Image):
        return _texels(g, shape)
    if isinstance(shape, (skies.Cap, skies.Cosine)):
        whole = isinstance(shape, skies.Cosine)
        depth = 1.0 if isinstance(shape, skies.Cosine) else shape.depth
        reach = 2.0 * math.asin(math.sqrt(min(1.0, 0.5 * depth)))
        if not (whole and shape.axis == (0.0, 0.0, 1.0)):
            region = _sky.around(shape.axis, reach, mirrored(wo), width)
            return _sky.adaptive(g, region)
    if kind == "half vector" and model.isotropic:
        return _sky.half_vector(g, wo, width)
    if kind:
        return _sky.adaptive(g, _sky.around(mirrored(wo), math.pi, mirrored(wo), width))
    if not model.built_in:  # may have a lobe that it does not tell of
        found = integrate(
            lambda w: g(w) * w[:, 2],
            _truth.coordinates(model, p, np.array(wo)),
            probes=_truth.probes(model, p, np.array(wo)),
        )
        return found.value, found.error
    return _sky.adaptive(g, _sky.hemisphere(wo, width))


def _array_sky(shape: skies.Shape) -> OfArray:
    """L on an array of directions (n, 3)."""
    import numpy as np

    if isinstance(shape, skies.Cosine):
        return lambda w: np.maximum(0.0, w @ np.array(shape.axis)) ** shape.exponent
    if isinstance(shape, (skies.Cap, skies.Constant, Image)):
        return lambda w: np.ones(len(w))  # the chart ends where the cap does
    function: Callable[..., Any] = skies.FUNCTIONS[type(shape)].radiance  # of arrays too
    return lambda w: function(tuple(w.T), shape)


def _texels(g: OfArray, shape: Image) -> tuple[float, float]:
    """Sum over texels of L times the integral of f cos over the texel, by two Gauss rules."""
    from montecarlo_brdf.references import _sky

    return _sky.texels(g, _texel_values(shape))


def _texel_values(shape: Image) -> Array:
    import ctypes

    import numpy as np

    size = int(shape.width * shape.height)
    memory = (ctypes.c_double * size).from_address(int(shape.address))
    return np.ctypeslib.as_array(memory).reshape(int(shape.height), int(shape.width))
