"""What the kernels average: one number per point u in [0, 1)^5, for every quantity and sampler.

`F`, `SAMPLE` and `PDF` are bound to a model's functions. `fixed` is the given direction (wo for the
albedo, wi for the reverse albedo) and a number that only some integrands use. The framework never
evaluates a model below the horizon: a drawn direction with z <= 0 was rejected and counts as 0.
"""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from montecarlo_brdf.sampling.charts import Row
from montecarlo_brdf.sampling.warps import random_hemisphere, random_hemisphere_cosine

F: Any = None
SAMPLE: Any = None
PDF: Any = None

PI = math.pi
TWO_PI = 2.0 * math.pi


def uniform_direction(u: Any, fixed: Any) -> Row:
    """The direction of a point, uniform over the hemisphere, and 1/pdf."""
    x, y, z = random_hemisphere(u[0], u[1])
    return x, y, z, TWO_PI, 0.0, 0.0, 0.0, 0.0


def cosine_direction(u: Any, fixed: Any) -> Row:
    """The direction of a point, cosine-weighted, and cos/pdf."""
    x, y, z = random_hemisphere_cosine(u[0], u[1])
    return x, y, z, PI, 0.0, 0.0, 0.0, 0.0


def albedo_uniform(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wi uniform over the hemisphere: E = A(wo)."""
    wi = uniform_direction(u, fixed)[:3]
    return F(fixed[:3], wi, p) * wi[2] * TWO_PI


def albedo_cosine(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wi cosine-weighted: E = A(wo), the cosine cancels."""
    wi = cosine_direction(u, fixed)[:3]
    return F(fixed[:3], wi, p) * PI


def drawn(wo: Any, u: Any, p: Any) -> tuple[float, float, float]:
    """(cos theta_i, f, pdf) of a direction from the model's sampler; f = 0 where it rejects.

    Integrands of one kernel share it: its work is compiled and done once.
    """
    wi = SAMPLE(wo, (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 0.0, 0.0, 1.0
    wi = wi[:3]
    return wi[2], F(wo, wi, p), PDF(wo, wi, p)


def albedo_own(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wi from the model's sampler: E = A(wo)."""
    mu, f, pdf = drawn(fixed[:3], u, p)
    return f * mu / pdf


def albedo_weighted(u: Any, fixed: Any, p: Any) -> float:
    """The weight f cos / pdf that the model's sampler returns itself: E = A(wo)."""
    wi = SAMPLE(fixed[:3], (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 0.0
    return wi[3]


def reverse_uniform(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wo uniform over the hemisphere: E = R(wi)."""
    wo = uniform_direction(u, fixed)[:3]
    return F(wo, fixed[:3], p) * wo[2] * TWO_PI


def reverse_cosine(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wo cosine-weighted: E = R(wi)."""
    wo = cosine_direction(u, fixed)[:3]
    return F(wo, fixed[:3], p) * PI


def reverse_own(u: Any, fixed: Any, p: Any) -> float:
    """f cos / pdf with wo drawn as the model's sampler would draw wi: E = R(wi)."""
    wi = fixed[:3]
    drawn = SAMPLE(wi, (u[0], u[1], u[4]), p)
    if drawn[2] <= 0.0:
        return 0.0
    wo = drawn[:3]
    return F(wo, wi, p) * wo[2] / PDF(wi, wo, p)


def bihemispherical_uniform(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, wi uniform: E = radiosity over irradiance under uniform light."""
    wo = random_hemisphere_cosine(u[2], u[3])
    wi = random_hemisphere(u[0], u[1])
    return F(wo, wi, p) * wi[2] * TWO_PI


def bihemispherical_cosine(u: Any, fixed: Any, p: Any) -> float:
    """wo and wi cosine-weighted: E = radiosity over irradiance under uniform light."""
    wo = random_hemisphere_cosine(u[2], u[3])
    wi = random_hemisphere_cosine(u[0], u[1])
    return F(wo, wi, p) * PI


def bihemispherical_own(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, wi from the model's sampler."""
    mu, f, pdf = drawn(random_hemisphere_cosine(u[2], u[3]), u, p)
    return f * mu / pdf


def bihemispherical_weighted(u: Any, fixed: Any, p: Any) -> float:
    """wo cosine-weighted, the weight that the model's sampler returns."""
    wi = SAMPLE(random_hemisphere_cosine(u[2], u[3]), (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 0.0
    return wi[3]


def second_uniform(u: Any, fixed: Any, p: Any) -> float:
    """E[x^2] of `albedo_uniform`, from draws by the model's own sampler, which sees its lobe."""
    mu, f, pdf = drawn(fixed[:3], u, p)
    return f * mu * f * mu * TWO_PI / pdf


def second_cosine(u: Any, fixed: Any, p: Any) -> float:
    """E[x^2] of `albedo_cosine`, from draws by the model's own sampler."""
    mu, f, pdf = drawn(fixed[:3], u, p)
    return f * f * mu * PI / pdf


def hemisphere_uniform(u: Any, fixed: Any, p: Any) -> float:
    """g / pdf with w uniform: E = the integral of g over the hemisphere."""
    return F(uniform_direction(u, fixed)[:3], p) * TWO_PI


def hemisphere_cosine(u: Any, fixed: Any, p: Any) -> float:
    """g / pdf with w cosine-weighted: E = the integral of g over the hemisphere."""
    w = cosine_direction(u, fixed)[:3]
    return F(w, p) * PI / w[2]


def rejected_own(u: Any, fixed: Any, p: Any) -> float:
    """1 where the model's sampler rejects: E = the rejected fraction."""
    wi = SAMPLE(fixed[:3], (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 1.0
    return 0.0


SKY: Any = None  # SKY(w, which): one kernel serves several skies, told apart by fixed[3]


def radiance_uniform(u: Any, fixed: Any, p: Any) -> float:
    """f L cos / pdf with wi uniform: E = reflected radiance under the light SKY."""
    wi = uniform_direction(u, fixed)[:3]
    return F(fixed[:3], wi, p) * wi[2] * SKY(wi, fixed[3]) * TWO_PI


def radiance_cosine(u: Any, fixed: Any, p: Any) -> float:
    """f L cos / pdf with wi cosine-weighted."""
    wi = cosine_direction(u, fixed)[:3]
    return F(fixed[:3], wi, p) * SKY(wi, fixed[3]) * PI


def radiance_own(u: Any, fixed: Any, p: Any) -> float:
    """f L cos / pdf with wi from the model's sampler."""
    wo = fixed[:3]
    wi = SAMPLE(wo, (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 0.0
    wi = wi[:3]
    return F(wo, wi, p) * wi[2] * SKY(wi, fixed[3]) / PDF(wo, wi, p)


def radiance_weighted(u: Any, fixed: Any, p: Any) -> float:
    """L times the weight that the model's sampler returns."""
    wi = SAMPLE(fixed[:3], (u[0], u[1], u[4]), p)
    if wi[2] <= 0.0:
        return 0.0
    return wi[3] * SKY(wi[:3], fixed[3])


#: The steps from a point to the direction that alone these integrands read. A kernel takes each for
#: a whole block of points; then `as_made` stands for it in the integrand.
STEPS: dict[Any, tuple[Callable[[Any, Any], Row], ...]] = {
    albedo_uniform: (uniform_direction,),
    albedo_cosine: (cosine_direction,),
    reverse_uniform: (uniform_direction,),
    reverse_cosine: (cosine_direction,),
    hemisphere_uniform: (uniform_direction,),
    hemisphere_cosine: (cosine_direction,),
    radiance_uniform: (uniform_direction,),
    radiance_cosine: (cosine_direction,),
}


def as_made(u: Any, fixed: Any) -> Any:
    """In place of a step that was taken before, or is not needed."""
    return u


#: integrands that use the coordinates 0, 1 and 4 of a point only
PLANE = frozenset(
    {
        albedo_uniform,
        albedo_cosine,
        albedo_own,
        albedo_weighted,
        reverse_uniform,
        reverse_cosine,
        reverse_own,
        second_uniform,
        second_cosine,
        rejected_own,
        hemisphere_uniform,
        hemisphere_cosine,
        radiance_uniform,
        radiance_cosine,
        radiance_own,
        radiance_weighted,
    }
)
