"""What single draws of a sampler say: faults, the Jacobian of the map, the weight, pdf anywhere.

A draw is a direction that belongs to numbers u; where it belongs to one pair of them only, the area
that a small square of u covers is 1/pdf.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.checks._hints import azimuth_named, moved_named, shape_named, wider_named
from montecarlo_brdf.checks._truth import AIM, integral, probes
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quadrature import Integral
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import Exact
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.statistics import Moments, estimate, hidden_error
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Flags

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


def values(case: Case, _: object) -> Exact:
    """How often pdf is negative or not finite, also where it is not drawn but asked by others."""
    count, points, where, hint = 0, 0, {}, None
    for k, p in enumerate(parameters.sets(case, 3)):
        rng = case.random(NAME, "values", k)
        wo, wi = directions.random_pairs(rng, case.budget(directions.RANDOM))
        density = pointwise(case.model, p).pdf(wo, wi)
        bad = ~(np.isfinite(density) & (density >= 0.0))
        if bad.any() and not count:
            j = int(np.argmax(bad))
            where = {**parameters.changed(case, p), **directions.place(wo[j], wi[j])}
            hint = f"pdf is {density[j]:.6g}: other samplers ask for it anywhere"
        count, points = count + int(bad.sum()), points + len(bad)
    return Exact(float(count), 0.0, where, points, hint=hint)


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


def faults(case: Case, theta: float) -> Exact:
    """How many draws are not finite, not of unit length, or have no density; all of them if none is
    above the horizon.

    Numbers exactly at an end of [0, 1) may give a direction where pdf and f are both 0, as u = 0
    does for u^(1/(n + 1)), or where pdf is infinite: no light, with probability 0. It is told, not
    refuted.
    """
    edges = _edges()
    inner = case.random(NAME, "edges", theta).random((case.budget(POINTS), 3))
    u = np.concatenate([edges, inner])
    kinds, dark = _kinds(case, np.array(case.wo(theta)), u)
    dark[len(edges) :] = False  # elsewhere than at the ends it is a fault like any other
    if case.model.pdf is not None:
        kinds["with a pdf that is not positive and finite"] &= ~dark
    counts = {name: int(bad.sum()) for name, bad in kinds.items()}
    said = ", ".join(f"{n} draws {name}" for name, n in counts.items() if n)
    first = next((int(np.argmax(bad)) for bad in kinds.values() if bad.any()), 0)
    hint = f"{said} (first at u = {tuple(float(v) for v in u[first])})" if said else None
    return Exact(float(sum(counts.values())), points=len(u), note=_told(u[dark]), hint=hint)


def _kinds(case: Case, wo: Array, u: Array) -> tuple[dict[str, Flags], Flags]:
    """Which draws have which fault, and which have neither pdf nor f."""
    functions = pointwise(case.model, case.one)
    w, weights = functions.sample(wo, u)
    finite = np.isfinite(w).all(axis=1)
    length = np.sqrt(np.sum(np.where(np.isfinite(w), w, 0.0) ** 2, axis=1))
    above, dark = finite & (w[:, 2] > 0.0), np.zeros(len(u), dtype=bool)
    kinds = {
        "not finite": ~finite,
        "not of unit length": above & (np.abs(length - 1.0) > UNIT_TOLERANCE),
    }
    if not above.any():
        kinds["below the horizon, which is all of them"] = finite
    if weighted(case.model):
        kinds["with a weight that is not finite"] = above & ~np.isfinite(weights)
    if case.model.pdf is not None:
        up = np.where(above[:, None], w, wo)
        density = functions.pdf(wo, up)
        bad = ~(np.isfinite(density) & (density > 0.0))
        kinds["with a pdf that is not positive and finite"] = above & bad
        dark = above & (density == 0.0) & (functions.f(wo, up) == 0.0)
        dark |= above & np.isposinf(density)
    return kinds, dark


def _told(u: Array) -> str | None:
    """That f/pdf is 0/0, or pdf infinite, at some ends of [0, 1), where that is so."""
    if not len(u):
        return None
    first = tuple(float(v) for v in u[0])
    return f"pdf is 0 as f, or infinite, at exactly u = {first}: a renderer must skip such draws"


def _edges() -> Array:
    """Numbers next to 0 and 1."""
    ends = (0.0, 5e-324, 2.0**-53, 0.5, 1.0 - 2.0**-53)
    return np.array([(a, b, 0.5) for a in ends for b in ends])


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
    """(pdf J, J, directions) of draws, J by central differences; pdf J is NaN below the horizon and
    where J is 0."""
    functions, wo = pointwise(case.model, case.one), np.array(case.wo(theta))
    w, _ = functions.sample(wo, u)
    steps = STEP * np.eye(3)[:2]
    slopes = [functions.sample(wo, u + h)[0] - functions.sample(wo, u - h)[0] for h in steps]
    area = np.linalg.norm(np.cross(slopes[0], slopes[1]), axis=1) / (2.0 * STEP) ** 2
    usable = np.isfinite(w).all(axis=1) & (w[:, 2] > 0.0) & (area > 0.0)
    density = functions.pdf(wo, np.where(usable[:, None], w, wo))
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


def weight(case: Case, theta: float) -> Exact:
    """The largest relative difference of the returned weight from f cos/pdf."""
    functions, wo = pointwise(case.model, case.one), np.array(case.wo(theta))
    _, w, weight = draws(case, theta, case.budget(POINTS))
    above = (w[:, 2] > 0.0) & np.isfinite(weight)
    expected = functions.f(wo, w[above]) * w[above][:, 2] / functions.pdf(wo, w[above])
    ratio = weight[above] / np.where(expected == 0.0, 1e-300, expected)
    ratio = np.where((expected == 0.0) & (weight[above] == 0.0), 1.0, ratio)
    k = int(np.argmax(np.abs(ratio - 1.0)))
    named = shape_named(ratio, np.broadcast_to(wo, w[above].shape), w[above])
    middle = f"{float(np.median(ratio)):.6g} in the middle"
    hint = f"weight/(f cos/pdf) = {named or middle}"
    whole = expected * functions.pdf(wo, w[above])
    if whole.any() and np.allclose(weight[above], whole, rtol=1e-6, atol=0.0):
        hint = "the weight is f cos: it is not divided by the pdf"
    return Exact(float(abs(ratio[k] - 1.0)), points=int(above.sum()), hint=hint)
