"""What single draws of a sampler say: faults, the weight, pdf anywhere."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, cast

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.cases.directions import unexplained
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.cases.survey import Survey
from montecarlo_brdf.checks._hints import shape_named
from montecarlo_brdf.checks._truth import AIM, integral, probes
from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.estimate.places import draws_of, mean_values
from montecarlo_brdf.estimate.quadrature import Integral, grid
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.judge.claim import Exact
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.spread import net
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Flags, Index

NAME = "pdf"  # whose streams these are
#: of the mass; the edge of the rejected region limits how fast the rejected fraction converges
MASS_TOLERANCE = 5e-4
#: of the length of a direction, and of a weight: thousands of roundings of a formula
UNIT_TOLERANCE = 1e-6
#: (slopes, azimuths), draws, and how many places are kept: of all places, then of those
MASSES = (((32, 24), 256, 24), ((128, 128), 1 << 14, 6))
INNER = 1e-9  # a number u is at an end if it is nearer to 0 or 1


def values(case: Case) -> Exact:
    """How often pdf is negative or not finite, also where it is not drawn but asked by others."""
    at = look(case)
    density = at.values(_pdf(case.model), at.points.wo, at.points.wi)
    (bad,) = np.nonzero(~(np.isfinite(density) & (density >= 0.0)))
    if not len(bad):
        return Exact(0.0, points=len(at))
    k = int(bad[0])
    hint = f"pdf is {density[k]:.6g}: other samplers ask for it anywhere{at.source(k)}"
    return Exact(float(len(bad)), 0.0, at.where(k), len(at), hint=hint)


def _pdf(model: Model) -> Function:
    """Of a model that has one."""
    return cast(Function, model.pdf)


def density_integral(case: Case, theta: float, seed: int = 0) -> Integral:
    """int pdf over the hemisphere, by quadrature; another for another seed."""
    return density_integral_of(case.model, case.one, case.wo(theta), seed)


@functools.lru_cache(maxsize=128)
def density_integral_of(model: Model, one: Parameters, wo: Vec, seed: int = 0) -> Integral:
    """The same for a model, a parameter set and a direction."""
    pdf, fixed = pointwise(model, one).pdf, np.array(wo)
    seen = probes(model, one, wo, seed=seed)
    return integral(lambda wi: pdf(fixed, wi), wo, seen, seed, AIM * MASS_TOLERANCE)


def faults(case: Case) -> Exact:
    """How many draws are not finite, not of unit length, or have no density; all of them if none is
    above the horizon.

    Numbers exactly at an end of [0, 1) may give a direction where pdf and f are both 0, as u = 0
    does for u^(1/(n + 1)), or where pdf is infinite: no light, with probability 0. It is told, not
    refuted.
    """
    at = look(case)
    kinds, dark = _kinds(at)
    u = at.points.u
    dark &= ((u < INNER) | (u > 1.0 - INNER)).any(axis=1)  # elsewhere it is a fault like any other
    kinds = {name: bad & ~dark if "pdf" in name else bad for name, bad in kinds.items()}
    counts = {name: int(bad.sum()) for name, bad in kinds.items()}
    first = next((int(np.argmax(bad)) for bad in kinds.values() if bad.any()), None)
    if first is None:
        return Exact(0.0, points=len(at), note=_told(u[dark]))
    said = ", ".join(f"{n} draws {name}" for name, n in counts.items() if n)
    hint = f"{said} (first at u = {tuple(map(float, u[first]))}){at.source(first)}"
    where = {k: v for k, v in at.where(first).items() if not k.endswith("_i_deg")}
    return Exact(float(sum(counts.values())), 0.0, where, len(at), note=_told(u[dark]), hint=hint)


def _kinds(at: Look) -> tuple[dict[str, Flags], Flags]:
    """Which draws have which fault, and which have neither pdf nor f."""
    w, weights = at.draws
    finite = np.isfinite(w).all(axis=1)
    length = np.sqrt(np.sum(np.where(np.isfinite(w), w, 0.0) ** 2, axis=1))
    above, dark = finite & (w[:, 2] > 0.0), np.zeros(len(w), dtype=bool)
    kinds = {
        "not finite": ~finite,
        "not of unit length": above & (np.abs(length - 1.0) > UNIT_TOLERANCE),
    }
    if not above.any():
        kinds["below the horizon, which is all of them"] = finite
    if weighted(at.model):
        kinds["with a weight that is not finite"] = above & ~np.isfinite(weights)
    if at.model.pdf is not None:
        up = np.where(above[:, None], w, at.points.wo)
        density = at.values(at.model.pdf, at.points.wo, up)
        bad = ~(np.isfinite(density) & (density > 0.0))
        kinds["with a pdf that is not positive and finite"] = above & bad
        dark = above & (density == 0.0) & (at.values(at.model.f, at.points.wo, up) == 0.0)
        dark |= above & np.isposinf(density)
    return kinds, dark


def _told(u: Array) -> str | None:
    """That f/pdf is 0/0, or pdf infinite, at some ends of [0, 1), where that is so."""
    if not len(u):
        return None
    first = tuple(float(v) for v in u[0])
    return f"pdf is 0 as f, or infinite, at exactly u = {first}: a renderer must skip such draws"


def weight(case: Case) -> Exact:
    """The largest relative difference of the returned weight from f cos/pdf, beyond rounding."""
    at = look(case)
    w, weights = at.draws
    (rows,) = np.nonzero(np.isfinite(weights) & (w[:, 2] > 0.0))
    wo, wi, weights = at.points.wo[rows], w[rows], weights[rows]

    def due(index: Index, a: Array, b: Array) -> Array:
        some = rows[index]
        f, pdf = at.values(at.model.f, a, b, some), at.values(_pdf(at.model), a, b, some)
        ratio: Array = f * b[:, 2] / np.where(pdf > 0.0, pdf, np.nan)
        return ratio

    expected = due(np.arange(len(rows)), wo, wi)
    known = np.isfinite(expected)  # where pdf is at fault its own claims say so
    apart = np.where(known, np.abs(weights - expected), 0.0)
    relative = apart / np.where(known & (expected != 0.0), np.abs(expected), 1e-300)
    rng = case.random(NAME, "weight")
    relative = unexplained(relative, apart, UNIT_TOLERANCE, due, [(wo, wi)], rng)
    k = int(np.argmax(relative)) if len(rows) else 0
    if not len(rows) or not relative[k] > UNIT_TOLERANCE:
        return Exact(float(relative.max(initial=0.0)), points=len(rows))
    hint = _weight_hint(weights, expected, wo, wi) + at.source(int(rows[k]))
    return Exact(float(relative[k]), 0.0, at.where(int(rows[k])), len(rows), hint=hint)


def _weight_hint(weights: Array, expected: Array, wo: Array, wi: Array) -> str:
    """What weight/(f cos/pdf) is."""
    usable = np.isfinite(expected) & (expected != 0.0)
    ratio = weights[usable] / expected[usable]
    named = shape_named(ratio, wo[usable], wi[usable])
    return f"weight/(f cos/pdf) = {named or f'{float(np.median(ratio)):.6g} in the middle'}"


def heaviest(at: Survey) -> list[int]:
    """The places where int pdf, in slopes of half vectors, and the rejected draws add up to what is
    farthest from 1, the farthest first."""
    index = np.arange(len(at.points.wo))
    for cells, draws, many in MASSES:
        found = np.abs(_masses(at, index, cells, draws) - 1.0)
        index = index[np.argsort(-np.where(np.isfinite(found), found, np.inf))[:many]]
    return [int(k) for k in index]


def _masses(at: Survey, index: Index, cells: tuple[int, int], draws: int) -> Array:
    groups, numbers = at.at.at(index), net(draws, 5)
    x, b, weight = grid(*cells)
    nodes = np.stack([x, b, np.zeros(len(x)), weight], axis=1)
    places = np.concatenate([groups.wo, np.ones((len(index), 1))], axis=1)
    mass = mean_values(at.model, Quantity.MASS, Sampler.SLOPES, nodes, places, groups.sets)
    many = np.repeat(np.arange(len(index)), draws)
    u = np.tile(numbers, (len(index), 1))
    w = draws_of(at.model, groups.wo[many], u, groups.sets.at(many))[0]
    found: Array = mass + (~(w[:, 2] > 0.0)).reshape(len(index), draws).mean(axis=1)
    return found
