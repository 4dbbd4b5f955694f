"""What single draws of a sampler say: faults, the Jacobian of the map, the weight, pdf anywhere.

A draw is a direction that belongs to numbers u; where it belongs to one pair of them only, the area
that a small square of u covers is 1/pdf.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, cast

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.cases.directions import unexplained
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.cases.survey import Survey
from montecarlo_brdf.checks._hints import azimuth_named, moved_named, shape_named, wider_named
from montecarlo_brdf.checks._truth import AIM, integral, probes
from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.estimate.places import Rows, draws_of, mean_values, values_of
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quadrature import Integral, grid
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import Exact
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.sampling.spread import net
from montecarlo_brdf.statistics import Moments, estimate, hidden_error
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Flags, Index

NAME = "pdf"  # whose streams these are
#: of the mass; the edge of the rejected region limits how fast the rejected fraction converges
MASS_TOLERANCE = 5e-4
#: of u in central differences: rounding of directions, 2^-53, is then below 10^-10 of a difference
STEP = 1e-5
#: keeps finite differences away from the poles of u, where their relative error is (STEP/u)^2/8
MARGIN = 2.0**-10
POINTS = 4096
#: numbers between which a difference of two draws tells that u[2] changes them
CHOICES = 256
#: of the length of a direction, and of a weight: thousands of roundings of a formula
UNIT_TOLERANCE = 1e-6
#: replicates of the mean of (1 - pdf Jacobian)+: Student's t of 63 degrees hides no tail
REPLICATES = 64
#: draws of a place where all laws are asked, and replicates
DRAWS_EACH, REPLICATES_EACH = 128, 8
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


def draws(case: Case, theta: float, n: int) -> tuple[Array, Array, Array]:
    """(u, directions, weights) of n draws."""
    u = _inner(case.random(NAME, theta), n)
    return u, *pointwise(case.model, case.one).sample(np.array(case.wo(theta)), u)


def _inner(rng: np.random.Generator, n: int) -> Array:
    """Numbers u (n, 3) that keep clear of 0 and 1."""
    return rng.random((n, 3)) * (1.0 - 2.0 * MARGIN) + MARGIN


def chooses(case: Case, theta: float) -> bool:
    """Whether u[2] changes the drawn direction."""
    u, w, _ = draws(case, theta, CHOICES)
    for third in (1.0 - u[:, 2], 2.0**-30, 1.0 - 2.0**-30):  # rare lobes lie at the ends
        u[:, 2] = third
        again, _ = pointwise(case.model, case.one).sample(np.array(case.wo(theta)), u)
        if not np.allclose(w, again, rtol=0.0, atol=1e-12, equal_nan=True):
            return True
    return False


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


def deficit(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """The mean of (1 - pdf J)+ over u, J = |dw/du0 x dw/du1|: the draws that pdf does not account
    for.

    Where a direction belongs to one pair of numbers, 1/J is the density q of the draws, and the
    mean is int (q - pdf)+ dw, the distance in total variation between draws and pdf. Where it
    belongs to several, q is the sum of their 1/J, of which an honest pdf exceeds every one: the
    mean is 0 again. A seam of the map within a step makes J large, no area (a number that changes
    nothing) says nothing: both count as 0. So what is found is a distance that there is at least.
    """
    place = (theta, case.phi_o_deg, *case.one)
    rng = np.random.default_rng(
        stream(plan.seed, case.model.identity, NAME, "Jacobian", *place, plan.samples)
    )
    each = -(-plan.samples // REPLICATES)
    ratio = _ratio(case, theta, _inner(rng, each * REPLICATES))[0]
    lost = np.where(np.isfinite(ratio), np.maximum(1.0 - ratio, 0.0), 0.0)
    e = estimate([_moments(part) for part in lost.reshape(REPLICATES, each)])
    unseen = hidden_error(1.0, e.second_moment - e.mean**2, e.samples)
    return [Measurement("differences", e._replace(stderr=max(e.stderr, unseen)))]


def _moments(x: Array) -> Moments:
    mean = float(x.mean())
    return Moments(float(len(x)), mean, float(np.sum((x - mean) ** 2)), float(x.max()))


def _ratio(case: Case, theta: float, u: Array) -> tuple[Array, Array, Array]:
    """`_ratios` of draws for one direction."""
    at = pointwise(case.model, case.one)
    return _ratios(at.model, np.tile(case.wo(theta), (len(u), 1)), u, at.sets)


def _ratios(model: Model, wo: Array, u: Array, sets: Rows) -> tuple[Array, Array, Array]:
    """(pdf J, J, directions) of draws, J by central differences; pdf J is NaN below the horizon and
    where J is 0."""
    w = draws_of(model, wo, u, sets)[0]
    steps = STEP * np.eye(3)[:2]
    ends = [[draws_of(model, wo, u + h, sets)[0] for h in (step, -step)] for step in steps]
    slopes = [ahead - behind for ahead, behind in ends]
    area = np.linalg.norm(np.cross(slopes[0], slopes[1]), axis=1) / (2.0 * STEP) ** 2
    usable = np.isfinite(w).all(axis=1) & (w[:, 2] > 0.0) & (area > 0.0)
    density = values_of(model, _pdf(model), wo, np.where(usable[:, None], w, wo), sets)
    return np.where(usable, density * area, np.nan), area, w


def _finite_ratio(case: Case, theta: float) -> tuple[Array, Array, Array]:
    """`_ratio` of some draws, where it is a number."""
    found = _ratio(case, theta, _inner(case.random(NAME, theta), POINTS))
    ratio, area, w = (part[np.isfinite(found[0])] for part in found)
    return ratio, area, w


def ratio_cause(case: Case, theta: float) -> str | None:
    """What pdf times Jacobian is: by the directions that pdf should have been asked for, or by its
    shape, where that has a name."""
    pdf, wo = pointwise(case.model, case.one).pdf, np.array(case.wo(theta))
    ratio, area, w = _finite_ratio(case, theta)
    many = np.broadcast_to(wo, w.shape)
    meant = moved_named(lambda a, b: pdf(a, b) * area, many, w)
    if meant:
        return f"pdf is the density of the draws {meant}"
    named = shape_named(ratio, many, w)
    return f"pdf / density of the draws = {named}" if named else None


def ratio_hint(case: Case, theta: float) -> str:
    """The same, or how it is spread and who is wider."""
    if named := ratio_cause(case, theta):
        return named
    ratio, area, w = _finite_ratio(case, theta)
    low, middle, high = np.quantile(ratio, (0.05, 0.5, 0.95))
    said = f"pdf / density of the draws = {middle:.4g} in the middle, {low:.4g} to {high:.4g}"
    return f"{said}{azimuth_named(ratio, w) or wider_named(ratio, ratio / area)}"


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


def deficits(at: Survey) -> Array:
    """(places, replicates) of the mean of (1 - pdf J)+, see `deficit`; only if u[2] changes
    nothing."""
    size = REPLICATES_EACH * at.case.budget(DRAWS_EACH // REPLICATES_EACH)
    many = np.repeat(np.arange(len(at.points.wo)), size)
    u = np.tile(_inner(at.case.random(NAME, "survey"), size), (len(at.points.wo), 1))
    ratio = _ratios(at.model, at.points.wo[many], u, at.at.sets.at(many))[0]
    lost = np.where(np.isfinite(ratio), np.maximum(1.0 - ratio, 0.0), 0.0)
    found: Array = lost.reshape(len(at.points.wo), REPLICATES_EACH, -1).mean(axis=2)
    return found


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
