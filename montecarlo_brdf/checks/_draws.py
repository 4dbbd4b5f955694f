"""What single draws of a sampler say: faults, the Jacobian of the map, the weight, pdf anywhere.

A draw is a direction that belongs to numbers u; where it belongs to one pair of them only, the area
that a small square of u covers is 1/pdf.
"""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, pointwise
from montecarlo_brdf.checks._hints import azimuth_named, moved_named, shape_named, wider_named
from montecarlo_brdf.checks._truth import lobe_scale, own_probes
from montecarlo_brdf.estimate.probe import returns_weight
from montecarlo_brdf.estimate.quadrature import Coordinates, Integral, integrate
from montecarlo_brdf.judge.claim import Exact

NAME = "pdf"  # whose streams these are
STEP, SHORTER = 1e-5, 1e-7
MARGIN = 2.0**-10  # keeps finite differences away from the poles of u, whose error is (h/u)^2/8
POINTS = 4096
DIFFERENCES = 2048  # points that take four more draws each
#: the share of points that may lie on seams of the map, where differences do not exist
SEAMS = 0.005
UNIT_TOLERANCE = 1e-6
JACOBIAN_TOLERANCE = 3e-3
#: standard errors and excess of a mass by which a direction surely belongs to several draws; what
#: pdf times Jacobian counts for at most, as a few large values tell nothing about a mean
SURE, EXCESS, CLIPPED = 5.0, 0.02, 4.0
#: mean excess that is left to the mass, or belongs to a lobe that is drawn so seldom
LITTLE = 0.05


def values(case: Case, _: Any) -> Exact:
    """How often pdf is negative or not finite, also where it is not drawn but asked by others."""
    count, points, where, hint = 0, 0, {}, None
    for k, p in enumerate(parameters.sets(case, 3)):
        wo, wi = directions.random_pairs(
            case.random(NAME, "values", k), case.budget(directions.RANDOM)
        )
        density = pointwise(case.model, p).pdf(wo, wi)
        bad = ~(np.isfinite(density) & (density >= 0.0))
        if bad.any() and not count:
            j = int(np.argmax(bad))
            where = {**parameters.changed(case, p), **directions.place(wo[j], wi[j])}
            hint = f"pdf is {density[j]:.6g}: other samplers ask for it anywhere"
        count, points = count + int(bad.sum()), points + len(bad)
    return Exact(float(count), 0.0, where, points, hint=hint)


def draws(case: Case, theta: float, n: int) -> tuple[Any, Any, Any]:
    """(u, directions, weights) of n draws."""
    u = case.random(NAME, theta).random((n, 3)) * (1.0 - 2.0 * MARGIN) + MARGIN
    return u, *pointwise(case.model, case.one).sample(np.array(case.wo(theta)), u)


def chooses(case: Case, theta: float) -> bool:
    """Whether u[2] changes the drawn direction."""
    u, w, _ = draws(case, theta, 256)
    for third in (1.0 - u[:, 2], 2.0**-30, 1.0 - 2.0**-30):  # rare lobes lie at the ends
        u[:, 2] = third
        again, _ = pointwise(case.model, case.one).sample(np.array(case.wo(theta)), u)
        if not np.allclose(w, again, rtol=0.0, atol=1e-12, equal_nan=True):
            return True
    return False


def density_integral(case: Case, theta: float) -> Integral:
    """int pdf over the hemisphere, by quadrature."""
    return density_integral_of(case.model, case.one, case.wo(theta))


@functools.lru_cache(maxsize=128)
def density_integral_of(case_model: Any, one: Any, wo: Any) -> Integral:
    direction = np.array(wo)
    coordinates = Coordinates(direction, lobe_scale(case_model, one, direction))
    functions = pointwise(case_model, one)
    seen = own_probes(case_model, one, wo)
    return integrate(lambda wi: functions.pdf(direction, wi), coordinates, probes=seen)


def faults(case: Case, theta: float) -> Exact:
    """How many draws are not finite, not of unit length, or have no density; all of them if none is
    above the horizon.

    Numbers exactly at an end of [0, 1) may give a direction where pdf and f are both 0, as u = 0
    does for u^(1/(n + 1)), or where pdf is infinite: no light, with probability 0. It is told, not
    refuted.
    """
    edges = _edges()
    u = np.concatenate([edges, case.random(NAME, "edges", theta).random((case.budget(POINTS), 3))])
    kinds, dark = _kinds(case, np.array(case.wo(theta)), u)
    dark[len(edges) :] = False  # elsewhere than at the ends it is a fault like any other
    if case.model.pdf is not None:
        kinds["with a pdf that is not positive and finite"] &= ~dark
    counts = {name: int(bad.sum()) for name, bad in kinds.items()}
    said = ", ".join(f"{n} draws {name}" for name, n in counts.items() if n)
    first = next((int(np.argmax(bad)) for bad in kinds.values() if bad.any()), 0)
    hint = f"{said} (first at u = {tuple(float(v) for v in u[first])})" if said else None
    return Exact(float(sum(counts.values())), points=len(u), note=_told(u[dark]), hint=hint)


def _kinds(case: Case, wo: Any, u: Any) -> tuple[dict[str, Any], Any]:
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
    if returns_weight(case.model):
        kinds["with a weight that is not finite"] = above & ~np.isfinite(weights)
    if case.model.pdf is not None:
        up = np.where(above[:, None], w, wo)
        density = functions.pdf(wo, up)
        bad = ~(np.isfinite(density) & (density > 0.0))
        kinds["with a pdf that is not positive and finite"] = above & bad
        dark = above & (density == 0.0) & (functions.f(wo, up) == 0.0)
        dark |= above & np.isposinf(density)
    return kinds, dark


def _told(u: Any) -> str | None:
    """That f/pdf is 0/0, or pdf infinite, at some ends of [0, 1), where that is so."""
    if not len(u):
        return None
    ends = tuple(float(v) for v in u[0])
    return f"pdf is 0 as f, or infinite, at exactly u = {ends}: a renderer must skip such draws"


def _edges() -> Any:
    """Numbers next to 0 and 1."""
    ends = (0.0, 5e-324, 2.0**-53, 0.5, 1.0 - 2.0**-53)
    return np.array([(a, b, 0.5) for a in ends for b in ends])


def jacobian(case: Case, theta: float) -> Exact:
    """The largest |pdf |dw/du1 x dw/du2| - 1| away from seams, by central differences.

    Of a map made of many pieces (a table of cells) many draws have a seam within a step, and few
    within a shorter one, which rounding allows where numbers have all their digits.
    """
    found = _differences(case, theta, STEP)
    if found.value <= JACOBIAN_TOLERANCE:
        return found
    shorter = _differences(case, theta, SHORTER)
    return shorter if shorter.value <= JACOBIAN_TOLERANCE else found


def _differences(case: Case, theta: float, h: float) -> Exact:
    functions, wo = pointwise(case.model, case.one), np.array(case.wo(theta))
    u, w, _ = draws(case, theta, DIFFERENCES)
    sides = []
    for axis in (0, 1):
        step = np.zeros(3)
        step[axis] = h
        ahead, behind = functions.sample(wo, u + step)[0], functions.sample(wo, u - step)[0]
        sides.append(((ahead - behind) / (2.0 * h), np.minimum(ahead[:, 2], behind[:, 2])))
    area = np.linalg.norm(np.cross(sides[0][0], sides[1][0]), axis=1)
    above = (w[:, 2] > 1e-3) & (np.minimum(sides[0][1], sides[1][1]) > 0.0)
    if above.sum() < 100:
        return Exact(0.0, points=0, note="hardly any draw lies above the horizon")
    w, area = w[above], area[above]
    ratio = functions.pdf(wo, w) * area
    if np.median(area) == 0.0:
        alone = "one of the two numbers changes nothing: see `sampling`"
        return Exact(0.0, points=len(w), note=alone)
    value = float(np.quantile(np.abs(ratio - 1.0), 1.0 - SEAMS))
    if value <= JACOBIAN_TOLERANCE:
        return Exact(value, points=len(w))
    below = float(np.quantile(1.0 - ratio, 1.0 - SEAMS))
    if below <= JACOBIAN_TOLERANCE:  # of several pairs pdf is the sum, too small for none of them
        if _belongs_to_several(case, theta, ratio, len(u)):
            several = "a direction belongs to several pairs of numbers: see `sampling`"
            return Exact(max(0.0, below), points=len(w), note=several)
        if float(np.minimum(ratio, CLIPPED).mean()) <= 1.0 + LITTLE:
            little = "pdf is a little above the density of some draws: the mass and `sampling` tell"
            return Exact(max(0.0, below), points=len(w), note=little)
    return Exact(value, points=len(w), hint=_ratio(functions.pdf, area, wo, w))


def _belongs_to_several(case: Case, theta: float, ratio: Any, drawn: int) -> bool:
    """Whether directions are drawn by more than one pair of numbers each (an azimuth folded, a
    number used twice): then pdf times Jacobian adds up to more than int pdf, whatever pdf is."""
    found = density_integral(case, theta)
    least = np.minimum(ratio, CLIPPED)
    spread = math.sqrt(float(np.sum((least - least.mean()) ** 2))) / drawn
    return bool(least.sum() / drawn - SURE * spread > found.value + found.error + EXCESS)


def _ratio(pdf: Any, area: Any, wo: Any, w: Any) -> str:
    """What pdf times Jacobian is: by the directions that pdf should have been asked for, by its
    shape where that has a name, by who is wider."""
    density = pdf(wo, w)
    ratio, many = density * area, np.broadcast_to(wo, w.shape)
    meant = moved_named(lambda a, b: pdf(a, b) * area, many, w)
    if meant:
        return f"pdf is the density of the draws {meant}"
    named = shape_named(ratio, many, w)
    if named:
        return f"pdf / density of the draws = {named}"
    low, middle, high = np.quantile(ratio, (0.05, 0.5, 0.95))
    said = f"pdf / density of the draws = {middle:.4g} in the middle, {low:.4g} to {high:.4g}"
    return f"{said}{azimuth_named(ratio, w) or wider_named(ratio, density)}"


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
    hint = f"weight/(f cos/pdf) = {named or f'{float(np.median(ratio)):.6g} in the middle'}"
    whole = expected * functions.pdf(wo, w[above])
    if whole.any() and np.allclose(weight[above], whole, rtol=1e-6, atol=0.0):
        hint = "the weight is f cos: it is not divided by the pdf"
    return Exact(float(abs(ratio[k] - 1.0)), points=int(above.sum()), hint=hint)
