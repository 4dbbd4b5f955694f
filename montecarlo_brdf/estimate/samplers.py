"""A model as an integral: its functions, samplers and charts, and the integrands made of them."""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

from montecarlo_brdf.compile.bind import Called
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import probe, quantity
from montecarlo_brdf.estimate.quantity import Integrand, Quantity
from montecarlo_brdf.model import Around, Model, ParameterSet, Prepared, channels
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import Vec

BLIND = (Sampler.UNIFORM, Sampler.COSINE)  # to what the model is
SAMPLERS = (*BLIND, Sampler.OWN)
LOBES = {Around.HALF_VECTOR: Sampler.HALF_VECTOR, Around.MIRROR: Sampler.MIRROR}


def charts_of(model: Model) -> tuple[Sampler, ...]:
    """The charts fitted to what the model declares: its lobe, its kinks."""
    lobe = (LOBES[model.lobe.around],) if model.lobe else ()
    return (*lobe, *((Sampler.PANELS,) if model.kinks else ()))


def samplers_of(model: Model, of: Quantity = Quantity.ALBEDO) -> tuple[Sampler, ...]:
    """The samplers by which a quantity of this model can be estimated."""
    if model.sample and (model.pdf or (weighted(model) and of is not Quantity.REVERSE)):
        return SAMPLERS
    return BLIND


def sampler_of(model: Model, name: str, of: Quantity = Quantity.ALBEDO) -> Sampler:
    """The sampler or chart of this name, or a UserError if the model does not offer it."""
    offered = (*samplers_of(model, of), *charts_of(model))
    if name not in offered:
        raise UserError(unknown(f"sampler for model {model.name}", name, offered))
    return Sampler(name)


@functools.lru_cache(maxsize=256)
def weighted(model: Model) -> bool:
    """Whether the model's sampler returns its weight f cos/pdf."""
    return probe.returns_weight(model)


def integrand(model: Model, of: Quantity, sampler: Sampler | str, **more: object) -> Integrand:
    """A quantity by a sampler or chart; one that returns its weight uses that. `more` names than
    the model's functions may be bound."""
    sampler = Sampler(sampler)
    own = sampler is Sampler.OWN and of not in (Quantity.REVERSE, Quantity.REJECTED)
    return quantity.integrand(of, sampler, {**functions_of(model), **more}, own and weighted(model))


def query(model: Model, p: ParameterSet, fixed: Vec) -> tuple[float, ...]:
    """What integrands get as `given`: the given direction and the width of the narrowest lobe."""
    if model.lobe is None:
        return (*fixed, 0.0)
    return (*fixed, min(float(model.lobe.width(one)) for one in channels(p)))


class Subject(NamedTuple):
    """What is integrated, as errors call it and as its streams are named, and K parameter sets."""

    name: str
    identity: tuple[str, ...]
    sets: list[Prepared]


def subject_of(model: Model, p: ParameterSet) -> Subject:
    """A model with one parameter set, colours channel by channel."""
    return Subject(model.name, identity_of(model, p), [model.prepared(c) for c in channels(p)])


def identity_of(model: Model, p: ParameterSet) -> tuple[str, ...]:
    """What tells a case's stream from others."""
    return (model.identity, *model.picks.values(), *map(repr, p))


def functions_of(model: Model) -> dict[str, Called]:
    """The functions that a model has, by the names under which integrands call them."""
    return {name: Called(function) for name, function in members_of(model).items()}


def members_of(model: Model) -> dict[str, Any]:
    """The same for integrands that look at parameters themselves."""
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    return {k: v for k, v in bound.items() if v is not None}
