"""Methods of an adaptive estimate: a chart or sampler with a point set, best first, and why."""
from __future__ import annotations

import functools
from typing import Any, NamedTuple

from montecarlo_brdf.compile.kernel import Kernel
from montecarlo_brdf.compile.layout import Layout, pack
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import looks, moments, quantity
from montecarlo_brdf.estimate.quantity import Integrand, Quantity
from montecarlo_brdf.estimate.samplers import charts_of, integrand, query, samplers_of
from montecarlo_brdf.estimate.subject import functions_of, identity_of
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import SETS


class Method(NamedTuple):
    """A sampler or chart, a point set, and why they were picked."""

    sampler: Sampler
    points: str
    why: str


class Setting(NamedTuple):
    """All that estimating a model with one parameter set needs, whatever the direction."""

    method: Method
    mean: Integrand
    layout: Layout
    looks: Kernel
    probed: bool
    numbers: tuple[float, ...]
    width: float  # of the lobe
    identity: str
    model: str

    @property
    def channels(self) -> int:
        """Number of parameter sets."""
        return len(self.layout.places)

    def means(self) -> Kernel:
        """The kernel of the mean alone."""
        return moments.kernel_of(self.model, self.method.points, [self.mean], self.layout)


@functools.lru_cache(maxsize=1024)
def methods(model: Model) -> list[Method]:
    """What to try, best first."""
    found = []
    for chart in charts_of(model)[:1]:
        kinked = chart is Sampler.PANELS
        what = "kinks" if kinked else f"{chart.replace('_', '-')} lobe"
        found.append(Method(chart, "lattice", f"the model declares its {what}"))
    if not found:
        found.append(Method(Sampler.COSINE, "lattice", "the model declares no lobe and no kinks"))
    if Sampler.OWN in samplers_of(model):
        found.append(Method(Sampler.OWN, "sobol", "its own sampler sees every lobe"))
    return [*found, Method(Sampler.COSINE, "sobol", "nothing better fits")]


def given(model: Model, sampler: str, points: str) -> Method:
    """The method that the user asked for, or a UserError."""
    offered = (*samplers_of(model), *charts_of(model))
    if sampler not in offered:
        raise UserError(unknown(f"sampler for model {model.name}", sampler, offered))
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    return Method(Sampler(sampler), points, "as given")


@functools.lru_cache(maxsize=256)
def told(method: Method, rejected: tuple[str, ...] = ()) -> str:
    """The method and why, as reports show it."""
    return "; ".join((f"{method.sampler} x {method.points}: {method.why}", *rejected))


@functools.lru_cache(maxsize=4096)
def prepare(model: Model, p: Any, kind: Any, method: Method) -> Setting:
    """Kernel and numbers of a case. `kind` keeps equal tuples of different variants apart."""
    layout, numbers = pack([model.prepared(c) for c in channels(p)], moments.QUERY)
    mean = integrand(model, Quantity.ALBEDO, method.sampler)
    mean = mean.for_lattice() if method.points == "lattice" else mean
    probe = quantity.probe_of(method.sampler, functions_of(model))
    identity = (method.points, *identity_of(model, p), "albedo")
    return Setting(
        method,
        mean,
        layout,
        looks.kernel_of(model.name, method.points, mean, probe, layout),
        probe is not None,
        tuple(numbers),
        query(model, p, (0.0, 0.0, 1.0))[3],
        "\x1f".join((*identity, method.sampler)),
        model.name,
    )
