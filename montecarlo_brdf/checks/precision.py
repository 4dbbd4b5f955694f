"""Precision: does single precision give what the formula gives in double?

A shader is compiled twice, as it is shipped, in single precision, and in double, of which all other
checks ask. Here both are asked at the same points in one kernel, drawn and weighted by the double
version: the difference needs few samples, and what is wrong with both cancels. (The shader's own
pdf would cancel its own errors, which it shares with f.) Asked at the parameters of the case alone:
how far down a range single precision carries is what `stress` tells.
It cannot see: what both versions get wrong; and a graphics processor does not round as this one.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases import directions
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.compile.bind import Bound, Called, bound, hole
from montecarlo_brdf.estimate import quantity, trust
from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Integrand, Quantity
from montecarlo_brdf.estimate.samplers import functions_of, subject_of
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge import finding
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, MeanClaim, Reference, Skip
from montecarlo_brdf.model import Model, Property
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import Vec, mirrored

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "precision"
QUESTION = "does single precision give what the formula gives?"
PROPERTY = Property.REFERENCE
MEAN_TOLERANCE = 1e-4  # of A and of the pdf's mass, relative: AGREEMENT_TOLERANCE
VALUE_TOLERANCE = 1e-3  # of f, relative
#: below this share of the mean of f where one looks, a deviation is measured against that
FLOOR = 1e-2
POINTS = 4096

#: f and pdf in single precision
Functions = Mapping[str, Callable[..., float]]

SINGLE: Callable[..., float] = hole()
DOUBLE: Callable[..., float] = hole()


def moved(wo: Vec, wi: Vec, p: Any) -> float:
    """What single precision adds."""
    return SINGLE(wo, wi, p) - DOUBLE(wo, wi, p)


def moved_per_cosine(wo: Vec, wi: Vec, p: Any) -> float:
    """The same of what is integrated without a cosine."""
    return (SINGLE(wo, wi, p) - DOUBLE(wo, wi, p)) / wi[2]


def applies(model: Model) -> bool:
    """Whether a model is known in single precision at all."""
    return model.single is not None


def claims(case: Case) -> Iterator[Claim]:
    """Per angle and channel: A, the mass of the pdf, and the farthest value of f."""
    if case.model.single is None:
        yield Skip("precision", f"model {case.model.name} has no single precision")
        return
    single = case.model.single()
    for theta in case.theta_o_deg:
        for k, one in enumerate(case.sets):
            where = case.where(theta_o_deg=theta)
            where |= {"channel": k} if len(case.sets) > 1 else {}
            there = case._replace(p=one)
            yield _mean("A single / A - 1", there, theta, where, _albedos(case.model, single), True)
            if case.model.pdf and case.model.sample and "pdf" in single:
                masses = _masses(case.model, single)
                yield _mean("pdf's mass, single - double", there, theta, where, masses, False)
            yield _farthest(there, theta, where, single["f"])


def _mean(
    name: str, case: Case, theta: float, where: dict[str, Any], pair: Pair, relative: bool
) -> MeanClaim:
    measure = functools.partial(_measured, case, theta, pair, relative)
    return MeanClaim(
        name,
        where,
        finding.Bound.EQUAL,
        Reference(0.0, 0.0, Kind.LAW, "the same formula in double precision"),
        case.tolerated(MEAN_TOLERANCE),
        measure,
        property=PROPERTY,
        diagnosis=functools.partial(_told, case, measure, "A" if relative else "the pdf's mass"),
    )


#: what is integrated in double, and what single precision adds to it
Pair = tuple[Integrand, Integrand]


def _sampler(model: Model) -> Sampler:
    """Draws that see a lobe of any width."""
    return Sampler.OWN if model.sample and model.pdf else Sampler.SLOPES


def _albedos(model: Model, single: Functions) -> Pair:
    """A."""
    double = functions_of(model)
    return _pair(model, double, bound(moved, SINGLE=Called(single["f"]), DOUBLE=double["F"]))


def _masses(model: Model, single: Functions) -> Pair:
    """int pdf, by the draws of the double version."""
    double, single_pdf = functions_of(model), Called(single["pdf"])
    change = bound(moved_per_cosine, SINGLE=single_pdf, DOUBLE=double["PDF"])
    return _pair(model, double, change)


def _pair(model: Model, functions: dict[str, Any], change: Bound) -> Pair:
    made = functools.partial(quantity.integrand, Quantity.ALBEDO, _sampler(model))
    return made(functions), made({**functions, "F": change})


def _measured(
    case: Case, theta: float, pair: Pair, relative: bool, plan: Plan
) -> list[Measurement]:
    """The change, as a share of A where it is A's; unfit where the estimate of A is."""
    sampler, wo = _sampler(case.model), case.wo(theta)
    own = sampler is Sampler.OWN
    side = 0.0 if own else _side(case, wo)
    subject = subject_of(case.model, case.p)
    whole, change = evaluate(subject, (*wo, side), pair, plan, (NAME,))[0]
    unfit = trust.measured(sampler, whole, trust.look(case.model, case.one, wo, own)).unfit
    scale = 1.0 / abs(whole.mean) if relative and whole.mean else 1.0
    return [Measurement(sampler, change.times(scale), unfit)]


def _side(case: Case, wo: Vec) -> float:
    """-1 where f is larger towards wo itself than towards its mirror direction, else 1."""
    back, mirror = pointwise(case.model, case.one).f(np.array(wo), np.array([wo, mirrored(wo)]))
    return -1.0 if back > mirror else 1.0


def _told(
    case: Case, measure: Callable[[Plan], list[Measurement]], what: str
) -> str:
    """By how much single precision moves it."""
    found = measure(Plan(seed=case.seed))[0].estimate.mean
    values = case.one._asdict().items()
    numbers = [f"{case.model.labels.get(n, n)} {v:g}" for n, v in values]
    at = f" at {', '.join(numbers)}" if len(numbers) in (1, 2, 3) else ""
    return f"single precision moves {what} by {found:.1e}{at}"


def _farthest(case: Case, theta: float, where: dict[str, Any], single: Any) -> ExactClaim:
    return ExactClaim(
        "f single / f - 1",
        where,
        finding.Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "the same formula in double precision"),
        VALUE_TOLERANCE if case.tolerance is None else 10.0 * case.tolerance,
        functools.partial(_worst, case, theta, single),
        property=PROPERTY,
    )


def _worst(case: Case, theta: float, single: Any) -> Exact:
    """The largest deviation of f where the model draws, and anywhere."""
    wo, wi = np.array(case.wo(theta)), _lights(case, theta)
    f = pointwise(case.model, case.one).f(wo, wi)
    other = dataclasses.replace(case.model, f=single, rebuild=None)
    with np.errstate(invalid="ignore"):  # both may be infinite
        off = np.abs(_rounded(other, case.one, wo, wi) - f)
    usual = float(np.mean(np.abs(f), where=np.isfinite(f))) if np.isfinite(f).any() else 0.0
    scale = np.maximum(np.abs(f), FLOOR * usual)
    relative = np.where(np.isfinite(f), off / np.where(scale > 0.0, scale, 1.0), 0.0)
    relative[np.isnan(relative)] = np.inf
    worst = int(np.argmax(relative))
    lost = np.isinf(relative[worst])
    hint = f"f is no number in single precision; in double it is {f[worst]:.6g}" if lost else None
    return Exact(float(relative[worst]), 0.0, directions.place(wo, wi[worst]), len(wi), hint=hint)


def _rounded(model: Model, p: Parameters, wo: Array, wi: Array) -> Array:
    return Pointwise(model, p).f(wo, wi)


def _lights(case: Case, theta: float) -> Array:
    """Directions above the horizon, half of them drawn by the model if it draws."""
    rng = case.random(NAME, theta)
    count = case.budget(POINTS, 64)
    _, wi = directions.random_pairs(rng, count)
    if case.model.sample is None:
        return wi
    sampler = pointwise(case.model, case.one)
    drawn, _ = sampler.sample(np.array(case.wo(theta)), rng.random((count, 3)))
    lengths = np.linalg.norm(drawn, axis=1)
    return np.concatenate([wi, drawn[(drawn[:, 2] > 0.0) & (np.abs(lengths - 1.0) < 1e-9)]])
