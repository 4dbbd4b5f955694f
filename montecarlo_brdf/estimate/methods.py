"""Methods of an adaptive estimate: a chart or sampler with a point set, best first, and why."""
from __future__ import annotations

import functools
from typing import Any, NamedTuple

from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import charted, moments
from montecarlo_brdf.estimate.looks import Climb
from montecarlo_brdf.estimate.recipe import Recipe
from montecarlo_brdf.estimate.samplers import (
    charts_of,
    integrand,
    integrand_name,
    query,
    samplers_of,
    suited_to,
)
from montecarlo_brdf.estimate.subject import functions_of, identity_of
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.sampling.points import SETS


class Method(NamedTuple):
    """A sampler or chart, a point set, and why they were picked."""

    sampler: str
    points: str
    why: str


class Setting(NamedTuple):
    """All that estimating a model with one parameter set needs, whatever the direction."""

    method: Method
    means: Recipe
    entry: Any  # the kernel of looks
    probed: bool
    numbers: tuple[float, ...]
    width: float  # of the lobe
    identity: str
    model: str


@functools.lru_cache(maxsize=1024)
def methods(model: Model) -> list[Method]:
    """What to try, best first."""
    found = []
    for chart in charts_of(model)[:1]:
        what = "kinks" if chart == "panels" else f"{chart.replace('_', '-')} lobe"
        found.append(Method(chart, "lattice", f"the model declares its {what}"))
    if not found:
        found.append(Method("cosine", "lattice", "the model declares no lobe and no kinks"))
    if "own" in samplers_of(model):
        found.append(Method("own", "sobol", "its own sampler sees every lobe"))
    return [*found, Method("cosine", "sobol", "nothing better fits")]


def given(model: Model, sampler: str, points: str) -> Method:
    """The method that the user asked for, or a UserError."""
    offered = (*samplers_of(model), *charts_of(model))
    if sampler not in offered:
        raise UserError(unknown(f"sampler for model {model.name}", sampler, offered))
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    return Method(sampler, points, "as given")


@functools.lru_cache(maxsize=256)
def told(method: Method, rejected: tuple[str, ...] = ()) -> str:
    """The method and why, as reports show it."""
    return "; ".join((f"{method.sampler} x {method.points}: {method.why}", *rejected))


@functools.lru_cache(maxsize=4096)
def prepare(model: Model, p: Any, kind: Any, method: Method) -> Setting:
    """Kernel and numbers of a case. `kind` keeps equal tuples of different variants apart."""
    layout, numbers = pack([model.prepared(c) for c in channels(p)], moments.QUERY)
    average = suited_to(method.points, integrand(integrand_name(model, "albedo", method.sampler)))
    means = Recipe(method.points, (average,), functions_of(model), layout)
    seen = getattr(charted, f"seen_{method.sampler}", None)
    identity = (method.points, *identity_of(model, p), "albedo")
    return Setting(
        method,
        means,
        compiled(model.name, Climb(means, seen)),
        seen is not None,
        tuple(numbers),
        query(model, p, (0.0, 0.0, 1.0))[3],
        "\x1f".join((*identity, method.sampler)),
        model.name,
    )
