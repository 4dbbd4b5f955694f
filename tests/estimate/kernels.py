"""The same integral by a kernel and by the plain Python functions it is made of."""
from __future__ import annotations

import math
import types
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from montecarlo_brdf.compile import kernel
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import integrands, work
from montecarlo_brdf.estimate.moments import QUERY
from montecarlo_brdf.estimate.recipe import Recipe
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling import points as sets
from montecarlo_brdf.statistics import Moments
from montecarlo_brdf.vectors import from_degrees

WO = from_degrees(50.0, 20.0)


def functions(model: Model) -> dict[str, Any]:
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    return {name: f for name, f in bound.items() if f is not None}


def job(model: Model, rows: Sequence[Any], names: Sequence[str], points: str, key: int,
        samples: int, replicates: int = 1) -> work.Job:  # fmt: skip
    """What `evaluate` asks of `work.run`, with its key chosen here."""
    layout, numbers = pack([model.prepared(p) for p in rows], QUERY)
    kinds = tuple(getattr(integrands, n) for n in names)
    entry = kernel.kernel_of(Recipe(points, kinds, functions(model), layout))
    shape = sets.SHAPES[points](samples) if points in sets.SHAPES else sets.NONE
    width = len(rows) * len(names)
    return work.Job(entry, (*WO, 0.0, *numbers), width, key, replicates, samples, shape)


def in_python(model: Model, p: Any, name: str) -> Callable[[Any], float]:
    """u -> x by the uncompiled integrand."""
    template = getattr(integrands, name)
    scope = {**template.__globals__, **functions(model)}
    scope["drawn"] = types.FunctionType(integrands.drawn.__code__, scope)  # sees the same names
    function = types.FunctionType(template.__code__, scope)
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
