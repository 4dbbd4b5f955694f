"""Estimators: a model, a direction and a sampler turned into an `Estimate`, never a bare float."""

from __future__ import annotations

import functools
import math
import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.errors import ModelError, UserError, unknown
from montecarlo_brdf.integration import build, charted, integrands, kernel, parameters, probe, work
from montecarlo_brdf.model import Model, NoParams, channels
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES
from montecarlo_brdf.sampling.streams import stream
from montecarlo_brdf.statistics import Estimate, estimate
from montecarlo_brdf.vectors import Vec, from_degrees

if TYPE_CHECKING:
    from montecarlo_brdf.integration.partial_sums import PartialSums

REPLICATES = 16
SAMPLERS = ("uniform", "cosine", "own")
MOST_SAMPLES = 1 << 40


class Subject(NamedTuple):
    """What is integrated: a name for its streams, functions to bind, and K parameter sets."""

    identity: tuple[str, ...]
    functions: Mapping[str, Any]
    sets: list[Any]


class Plan(NamedTuple):
    """How to sample."""

    points: str = "sobol"
    samples: int = 1 << 16
    replicates: int = REPLICATES
    seed: int = 0
    threads: int = 1
    progress: work.Progress | None = None
    target_error: float | None = None  # relative; None: just the samples asked for
    method: str = "given"  # or "auto": sampler and points are chosen, also with a target
    sums: PartialSums | None = None  # where long jobs keep how far they are


def check_samples(samples: Any) -> int:
    """A number of samples between 1 and 2^40, or a UserError."""
    if (
        isinstance(samples, bool)
        or not isinstance(samples, int)
        or not 1 <= samples <= MOST_SAMPLES
    ):
        raise UserError(f"samples must be a whole number from 1 to 2^40, not {samples}")
    return samples


def check_theta(theta_deg: Any, name: str = "theta_o_deg") -> float:
    """A polar angle in [0, 90) degrees, or a UserError."""
    try:
        theta = float(theta_deg)
    except (TypeError, ValueError):
        theta = math.nan
    if not 0.0 <= theta < 90.0:
        raise UserError(f"{name} must be an angle in [0, 90) degrees, not {theta_deg}")
    return theta


def charts_of(model: Model) -> tuple[str, ...]:
    """The charts fitted to what the model declares: its lobe, its kinks."""
    return (*filter(None, (lobe_kind(model),)), *(("panels",) if model.kinks else ()))


def samplers_of(model: Model, quantity: str = "albedo") -> tuple[str, ...]:
    """The samplers by which a quantity of this model can be estimated."""
    if model.sample and (model.pdf or (_weighted(model) and quantity != "reverse")):
        return SAMPLERS
    return SAMPLERS[:2]


def directional_albedo(
    model: Model,
    p: Any,
    theta_o_deg: float | Sequence[float],
    *,
    phi_o_deg: float = 0.0,
    sampler: str = "cosine",
    points: str = "sobol",
    samples: int = 1 << 16,
    seed: int = 0,
    replicates: int = REPLICATES,
    threads: int = 1,
    target_error: float | None = None,
    method: str | None = None,
) -> Any:
    """Directional albedo A(wo) = int f cos(theta_i) dwi, with its error bar.

    theta_o_deg, phi_o_deg: direction of the viewer in degrees, theta in [0, 90).
    sampler: "uniform", "cosine", "own" or a chart that fits the model ("half_vector", "mirror",
    "panels"); points: "independent", "stratified", "sobol" or "lattice"; samples: the total over
    all replicates. target_error: take as many samples as needed until the 99 % half-width is below
    this relative error, and choose sampler and points (method "auto", told in the estimate's
    `method`; "given" keeps sampler and points). method "auto" alone chooses for `samples`.
    Returns an Estimate; a list of one per channel for a colour; for a list of angles or of
    parameter sets a list of that. Raises UserError for a bad value, ModelError if the model does
    not compile or raises.
    """
    if isinstance(p, list) or isinstance(theta_o_deg, (list, tuple)):
        rest = {k: v for k, v in locals().items() if k not in ("model", "p", "theta_o_deg")}
        return _each(directional_albedo, model, p, theta_o_deg, rest)
    chosen = method or ("given" if target_error is None else "auto")
    plan = Plan(points, samples, replicates, seed, threads, None, target_error, chosen)
    wo = from_degrees(check_theta(theta_o_deg), phi_o_deg)
    if target_error is None and chosen == "given":
        return _one(model, p, "albedo", wo, sampler, plan)
    from montecarlo_brdf.integration import adaptive

    found, _ = adaptive.albedo(model, p, wo, plan, sampler)
    return found[0] if len(found) == 1 else found


def _each(function: Any, model: Model, p: Any, angles: Any, rest: dict[str, Any]) -> list[Any]:
    """One result per parameter set, angle, or both (nested)."""
    if isinstance(p, list):
        return [function(model, one, angles, **rest) for one in p]
    return [function(model, p, angle, **rest) for angle in angles]


def reverse_albedo(
    model: Model,
    p: Any,
    theta_i_deg: float,
    *,
    phi_i_deg: float = 0.0,
    sampler: str = "cosine",
    points: str = "sobol",
    samples: int = 1 << 16,
    seed: int = 0,
    replicates: int = REPLICATES,
    threads: int = 1,
) -> Any:
    """Reverse albedo R(wi) = int f cos(theta_o) dwo: all the light that leaves, for light from wi.

    This is what energy conservation bounds by 1; it equals A only if f is reciprocal. Arguments and
    result as for `directional_albedo`.
    """
    plan = Plan(points, samples, replicates, seed, threads)
    wi = from_degrees(check_theta(theta_i_deg, "theta_i_deg"), phi_i_deg)
    return _one(model, p, "reverse", wi, sampler, plan)


def bihemispherical_albedo(
    model: Model,
    p: Any,
    *,
    sampler: str = "cosine",
    points: str = "sobol",
    samples: int = 1 << 16,
    seed: int = 0,
    replicates: int = REPLICATES,
    threads: int = 1,
) -> Any:
    """Radiosity over irradiance under uniform light, 2 int A(mu) mu dmu, between 0 and 1."""
    plan = Plan(points, samples, replicates, seed, threads)
    return _one(model, p, "bihemispherical", (0.0, 0.0, 1.0), sampler, plan)


def _one(model: Model, p: Any, quantity: str, fixed: Vec, sampler: str, plan: Plan) -> Any:
    model = model.of(p)
    offered = (*samplers_of(model, quantity), *charts_of(model))
    if sampler not in offered:
        raise UserError(unknown(f"sampler for model {model.name}", sampler, offered))
    names = [integrand_name(model, quantity, sampler)]
    rows = estimates(model, p, fixed, names, plan, (quantity, sampler))
    return rows[0][0] if len(rows) == 1 else [row[0] for row in rows]


def integrand_name(model: Model, quantity: str, sampler: str) -> str:
    """The integrand for a quantity and sampler; a sampler that returns its weight uses that."""
    weighted = sampler == "own" and _weighted(model) and quantity != "reverse"
    return f"{quantity}_{'weighted' if weighted else sampler}"


@functools.lru_cache(maxsize=256)
def _weighted(model: Model) -> bool:
    return probe.returns_weight(model)


def estimates(
    model: Model, p: Any, fixed: Vec, names: Sequence[str], plan: Plan, label: tuple[Any, ...]
) -> list[list[Estimate]]:
    """Estimates of several integrands on the same points: result[channel][integrand]."""
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    subject = Subject(
        (model.name, *model.picks.values(), *map(repr, p)),
        {k: v for k, v in bound.items() if v is not None},
        [model.prepared(c) for c in channels(p)],
    )
    return evaluate(subject, query(model, p, fixed), [integrand(n) for n in names], plan, label)


def integrand(name: str) -> Any:
    """The integrand called `name`, plain or in a chart."""
    return getattr(integrands, name, None) or getattr(charted, name)


def suited_to(points: str, function: Any) -> Any:
    """An integrand as a point set needs it: periodic for a lattice."""
    quantity, _, sampler = function.__name__.partition("_")
    if points != "lattice" or sampler in charted.CHARTS:
        return function
    twice = quantity == "bihemispherical"
    return build.Wrapped(charted.periodised_twice if twice else charted.periodised, function)


def query(model: Model, p: Any, fixed: Vec) -> tuple[float, ...]:
    """What integrands get as `fixed`: the given direction and the width of the narrowest lobe."""
    if not lobe_kind(model):
        return (*fixed, 0.0)
    return (*fixed, min(float(model.lobe[1](one)) for one in channels(p)))


def lobe_kind(model: Model) -> str:
    """ "half_vector", "mirror" or "": the chart that fits the lobe that the model declares."""
    kind = model.lobe[0].replace(" ", "_") if isinstance(model.lobe, tuple) else ""
    return kind if kind in charted.CHARTS else ""


def hemisphere_integral(
    function: Any, p: Any = NoParams(), *, sampler: str = "uniform", plan: Plan = Plan()
) -> Estimate:
    """The integral of function(w, p) over the hemisphere, per solid angle, by uniform or cosine
    sampling."""
    if sampler not in SAMPLERS[:2]:
        raise UserError(unknown("sampler", sampler, SAMPLERS[:2]))
    subject = Subject((function.__qualname__, *map(repr, p)), {"F": function}, [p])
    kind = integrands.hemisphere_uniform if sampler == "uniform" else integrands.hemisphere_cosine
    return evaluate(subject, (0.0, 0.0, 1.0), [kind], plan, ("hemisphere", sampler))[0][0]


def evaluate(
    subject: Subject,
    fixed: Sequence[float],
    functions: Sequence[Any],
    plan: Plan,
    label: tuple[Any, ...],
    common: bool = False,
) -> list[list[Estimate]]:
    """The same for any functions bound into integrands; `label` names the stream with the subject.

    common: the same random numbers for every direction, so that what is searched is smooth.
    """
    check_samples(plan.samples)
    if plan.points not in SETS:
        raise UserError(unknown("point set", plan.points, SETS))
    replicates = max(1, min(plan.replicates, plan.samples))
    per_replicate = _per_replicate(plan, replicates)
    place = () if common else fixed
    key = stream(plan.seed, plan.points, *subject.identity, *label, *place)
    rows = []
    for group in _groups(subject.sets, len(functions)):
        layout, numbers = parameters.pack(group, kernel.QUERY)
        suited = tuple(suited_to(plan.points, f) for f in functions)
        recipe = build.Recipe(plan.points, suited, subject.functions, layout)
        entry = compiled(subject.identity[0], recipe)
        width = len(group) * len(functions)
        reals = (*(*fixed, 0.0)[: kernel.QUERY], *numbers)
        shape = SHAPES[plan.points](per_replicate) if plan.points in SHAPES else NONE
        job = work.Job(entry, reals, width, key, replicates, per_replicate, shape)
        results = [estimate(m) for m in work.run(job, plan.threads, plan.progress, plan.sums)]
        rows += [results[i : i + len(functions)] for i in range(0, width, len(functions))]
    return rows


def _groups(sets: list[Any], width: int) -> list[list[Any]]:
    """Channels that share a kernel: as many as fit a small stack."""
    size = max(1, 16 // width)
    return [sets[i : i + size] for i in range(0, len(sets), size)]


def _per_replicate(plan: Plan, replicates: int) -> int:
    """Samples in each replicate, rounded up to what the point set needs."""
    each = -(-plan.samples // replicates)
    most, power_of_two = SETS[plan.points]
    each = 1 << (each - 1).bit_length() if power_of_two else each
    if each > most:
        raise UserError(f"{plan.points} points allow {most} samples per replicate, not {each}")
    return each


def compiled(name: str, recipe: build.Buildable) -> Any:
    """The kernel of a recipe for model `name`; numba's complaints become one sentence."""
    try:
        with warnings.catch_warnings():  # what matters of them shows in the error or in the verdict
            warnings.simplefilter("ignore")
            return build.kernel_of(recipe)
    except (MemoryError, UserError):
        raise
    except Exception as error:  # what numba cannot compile ends in errors of every kind
        raise ModelError(f"model {name} does not compile: {_first_reason(error)}") from error


def _first_reason(error: Exception) -> str:
    """The line of a numba error that says what is wrong, without its stack of contexts."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    telling = [line for line in lines if not line.startswith(("Failed in", "During:", "-", "File"))]
    reason = (telling or lines or ["numba gave no reason"])[0]
    return " ".join(reason.partition(": %")[0].split())[:300]  # without the machine's own names
