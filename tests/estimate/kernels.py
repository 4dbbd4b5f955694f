"""The same integral by a kernel and by the plain Python functions it is made of."""
from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import evaluate
from montecarlo_brdf.estimate import moments as template
from montecarlo_brdf.estimate.quantity import Integrand, Quantity
from montecarlo_brdf.estimate.samplers import integrand
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling import points as sets
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.statistics import Moments
from montecarlo_brdf.vectors import from_degrees

WO = from_degrees(50.0, 20.0)


def named(model: Model, name: str) -> Integrand:
    """'albedo_cosine' as an integrand of a model."""
    quantity, _, sampler = name.partition("_")
    return integrand(model, Quantity(quantity), Sampler(sampler))


def job(model: Model, rows: Sequence[Any], names: Sequence[str], points: str, key: int,
        samples: int, replicates: int = 1) -> evaluate.Job:  # fmt: skip
    """What `evaluate` asks of `evaluate.run`, with its key chosen here."""
    layout, numbers = pack([model.prepared(p) for p in rows], template.QUERY)
    kinds = [named(model, n) for n in names]
    kernel = template.kernel_of(model.name, points, kinds, layout)
    shape = sets.SHAPES[points](samples) if points in sets.SHAPES else sets.NONE
    width = len(rows) * len(names)
    return evaluate.Job(kernel, (*WO, 0.0, *numbers), width, key, replicates, samples, shape)


def in_python(model: Model, p: Any, name: str) -> Callable[[Any], float]:
    """u -> x by the uncompiled integrand."""
    function = Specialiser(lambda plain: plain, {}).bind(named(model, name).template)
    return lambda u: float(function(u, (*WO, 0.0), model.prepared(p)))


def values(model: Model, p: Any, name: str, points: str, key: int, replicate: int,
           indices: range, shape: Any = sets.NONE) -> Iterator[float]:  # fmt: skip
    """x at the points of one replicate."""
    evaluate = in_python(model, p, name)
    own = sets.replicate_key(key, replicate)
    for i in indices:
        yield evaluate(getattr(sets, points)(own, i, shape))


def moments(x: Sequence[float]) -> Moments:
    """Count, mean, squares and largest, summed exactly."""
    mean = math.fsum(x) / len(x)
    return Moments(len(x), mean, math.fsum((v - mean) ** 2 for v in x), max(x))
