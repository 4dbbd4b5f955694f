"""The samplers and charts that a model offers, and the integrands that stand for them."""

from __future__ import annotations

import functools
from typing import Any

from montecarlo_brdf.estimate import charted, integrands, probe
from montecarlo_brdf.estimate.recipe import Wrapped
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.vectors import Vec

SAMPLERS = ("uniform", "cosine", "own")


def charts_of(model: Model) -> tuple[str, ...]:
    """The charts fitted to what the model declares: its lobe, its kinks."""
    return (*filter(None, (lobe_kind(model),)), *(("panels",) if model.kinks else ()))


def lobe_kind(model: Model) -> str:
    """ "half_vector", "mirror" or "": the chart that fits the lobe that the model declares."""
    kind = model.lobe[0].replace(" ", "_") if isinstance(model.lobe, tuple) else ""
    return kind if kind in charted.CHARTS else ""


def samplers_of(model: Model, quantity: str = "albedo") -> tuple[str, ...]:
    """The samplers by which a quantity of this model can be estimated."""
    if model.sample and (model.pdf or (_weighted(model) and quantity != "reverse")):
        return SAMPLERS
    return SAMPLERS[:2]


@functools.lru_cache(maxsize=256)
def _weighted(model: Model) -> bool:
    return probe.returns_weight(model)


def integrand_name(model: Model, quantity: str, sampler: str) -> str:
    """The integrand for a quantity and sampler; a sampler that returns its weight uses that."""
    weighted = sampler == "own" and _weighted(model) and quantity != "reverse"
    return f"{quantity}_{'weighted' if weighted else sampler}"


def integrand(name: str) -> Any:
    """The integrand called `name`, plain or in a chart."""
    return getattr(integrands, name, None) or getattr(charted, name)


def suited_to(points: str, function: Any) -> Any:
    """An integrand as a point set needs it: periodic for a lattice."""
    quantity, _, sampler = function.__name__.partition("_")
    if points != "lattice" or sampler in charted.CHARTS:
        return function
    twice = quantity == "bihemispherical"
    return Wrapped(charted.periodised_twice if twice else charted.periodised, function)


def query(model: Model, p: Any, fixed: Vec) -> tuple[float, ...]:
    """What integrands get as `fixed`: the given direction and the width of the narrowest lobe."""
    if model.lobe is None or not lobe_kind(model):
        return (*fixed, 0.0)
    return (*fixed, min(float(model.lobe.width(one)) for one in channels(p)))
