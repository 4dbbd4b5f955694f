"""Draws against the density that they have: pdf at single directions, and weights without a pdf.

The density of the draws at a direction is a sum over all numbers that give it (estimate.density).
A number that is missed makes it smaller; so a pdf below it is wrong, whatever was missed, and what
is estimated is a distance that there is at least.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import TYPE_CHECKING, cast

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.cases.survey import Survey, sure
from montecarlo_brdf.checks._hints import azimuth_named, moved_named, shape_named, wider_named
from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.estimate.density import Density, density, inner, pieces_of
from montecarlo_brdf.estimate.pieces import Piece, extents
from montecarlo_brdf.estimate.places import draws_of, values_of
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.tangents import STEP, tangents
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.mean import FRESH
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.statistics import Moments, estimate, hidden_error
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index

NAME = "pdf"  # whose streams these are
#: draws that tell whether directions belong to several numbers
LOOK = 1 << 10
#: draws of a look that are asked for, and at most, where directions do: a search costs as much as
#: ten draws
SHARE, MOST = 4, 1 << 14
#: of the step in differences, where a refutation must be confirmed
OTHER = 3.0
#: replicates of a mean: Student's t of 63 degrees hides no tail
REPLICATES = 64
#: draws of a place where all laws are asked, and replicates
DRAWS_EACH, REPLICATES_EACH = 64, 8
FEWEST = 0.01  # of the draws: a share without a density that is worth telling


def look(case: Case, theta: float) -> Density:
    """Some draws with all their roots."""
    return _look(case.model, case.one, case.wo(theta), case.seed)


@functools.lru_cache(maxsize=32)
def _look(model: Model, one: Parameters, wo: Vec, seed: int) -> Density:
    return _density(model, one, wo, LOOK, seed, True)


def _density(
    model: Model, one: Parameters, wo: Vec, n: int, seed: int, others: bool
) -> Density:
    rng = np.random.default_rng(stream(seed, model.identity, NAME, "density", *wo, *one, n))
    step = STEP * (OTHER if seed >= FRESH else 1.0)
    return density(model, one, wo, inner(rng, n), seed & 0xFFFF, step, others)


def unknown(case: Case, theta: float) -> str | None:
    """Why the density of the draws is not known at all, if it is not."""
    seen = look(case, theta)
    if seen.unknown is None and np.isnan(seen.density).all():
        return "its draws lie on curves or at points: two of their numbers move none of them"
    return seen.unknown


def several(case: Case, theta: float) -> bool:
    """Whether directions belong to several numbers, as in a mixture of lobes: of draws that do, 2 %
    show with a probability of 1 - 10^-9."""
    return bool((look(case, theta).roots.sum(axis=1) > 1).any())


def averages(case: Case, theta: float) -> bool:
    """Whether a weight may be right on average alone: where directions belong to several numbers,
    or nobody knows."""
    return bool(unknown(case, theta)) or several(case, theta)


def chooses(case: Case, theta: float) -> bool:
    """Whether u[2] changes the drawn direction."""
    found = pieces_of(case.model, case.one, case.wo(theta))
    return isinstance(found, str) or len(found) > 1 or found[0].idle != 2


def lacking(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """The mean of (1 - pdf/density)+ over draws: int (density - pdf)+ dw, the distance in total
    variation of draws and pdf if pdf has the mass that it must have. Draws without a density count
    as 0."""
    return [_lack(case, theta, _drawn(case, theta, plan))]


def _lack(case: Case, theta: float, at: Density) -> Measurement:
    """Of these draws."""
    pdf = _values(case, theta, _pdf(case.model), at.w)
    with np.errstate(all="ignore"):
        return _mean(1.0 - pdf / _surely(at, at.density), at)


def overweight(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """The mean over draws of (1 - f cos/(density E[weight | w]))+: what f does not account for of
    the mean weight of all draws with a direction."""
    at = _drawn(case, theta, plan)
    due = _values(case, theta, case.model.f, at.w) * at.w[:, 2]
    with np.errstate(all="ignore"):
        return [_mean(1.0 - due / _surely(at, at.light), at)]


def _surely(at: Density, value: Array) -> Array:
    """The density, or what is a share of it, less what differences leave open; NaN where that is
    all of it, as at a seam of the map."""
    share = 1.0 - at.error / at.density
    return np.where((share > 0.0) & (value > 0.0), share * value, np.nan)


def _drawn(case: Case, theta: float, plan: Plan) -> Density:
    """Draws of a plan with their density: where directions belong to one pair of numbers each, the
    own ones of more."""
    others = several(case, theta)
    n = min(MOST, max(LOOK, plan.samples // SHARE)) if others else plan.samples
    n = REPLICATES * -(-n // REPLICATES)
    return _afresh(case.model, case.one, case.wo(theta), n, plan.seed, others)


#: pdf and weights ask one after the other
_afresh = functools.lru_cache(maxsize=2)(_density)


def _pdf(model: Model) -> Function:
    """Of a model that has one."""
    return cast(Function, model.pdf)


def _values(case: Case, theta: float, function: Function, w: Array) -> Array:
    at, wo = pointwise(case.model, case.one), np.array(case.wo(theta))
    up = np.where((np.isfinite(w).all(axis=1) & (w[:, 2] > 0.0))[:, None], w, wo)
    return values_of(at.model, function, wo, up, at.sets)


def _mean(lost: Array, at: Density) -> Measurement:
    """Of a share between 0 and 1 of each draw, 0 where it is no number."""
    clipped = np.clip(np.where(np.isfinite(lost), lost, 0.0), 0.0, 1.0)
    e = estimate([_moments(part) for part in clipped.reshape(REPLICATES, -1)])
    unseen = hidden_error(1.0, e.second_moment - e.mean**2, e.samples)
    without = float(np.isnan(at.density).mean()) - at.rejected
    told = f"{without:.0%} of the draws have no density" if without > FEWEST else ""
    return Measurement("roots", e._replace(stderr=max(e.stderr, unseen), method=told))


def _moments(x: Array) -> Moments:
    mean = float(x.mean())
    return Moments(float(len(x)), mean, float(np.sum((x - mean) ** 2)), float(x.max()))


def ratio_cause(case: Case, theta: float) -> str | None:
    """What pdf over the density of the draws is: by the directions that pdf should have been asked
    for, or by its shape, where that has a name and directions belong to one pair of numbers."""
    if unknown(case, theta) or several(case, theta):
        return None
    pdf, wo = pointwise(case.model, case.one).pdf, np.array(case.wo(theta))
    ratio, due, w = _ratio(case, theta)
    many = np.broadcast_to(wo, w.shape)
    meant = moved_named(lambda a, b: pdf(a, b) / due, many, w)
    if meant:
        return f"pdf is the density of the draws {meant}"
    named = shape_named(ratio, many, w)
    return f"pdf / density of the draws = {named}" if named else None


def ratio_hint(case: Case, theta: float) -> str:
    """The same, or how it is spread and who is wider."""
    if named := ratio_cause(case, theta):
        return named
    ratio, due, w = _ratio(case, theta)
    low, middle, high = np.quantile(ratio, (0.05, 0.5, 0.95))
    said = f"pdf / density of the draws = {middle:.4g} in the middle, {low:.4g} to {high:.4g}"
    if several(case, theta):
        return said
    return f"{said}{azimuth_named(ratio, w) or wider_named(ratio, ratio * due)}"


def weight_hint(case: Case, theta: float) -> str:
    """What the mean weight over f cos/density is."""
    at = look(case, theta)
    due = _values(case, theta, case.model.f, at.w) * at.w[:, 2] / at.density
    ratio = at.mean_weight / due
    low, middle, high = np.nanquantile(ratio[np.isfinite(ratio)], (0.05, 0.5, 0.95))
    said = f"mean weight / (f cos/density) = {middle:.4g} in the middle"
    return f"{said}, {low:.4g} to {high:.4g}"


def _ratio(case: Case, theta: float) -> tuple[Array, Array, Array]:
    """pdf/density, the density and the directions of some draws, where they are numbers."""
    at = look(case, theta)
    rows = ~np.isnan(at.density)
    w, due = at.w[rows], at.density[rows]
    ratio = _values(case, theta, _pdf(case.model), w) / due
    return ratio, due, w


def farthest(at: Survey) -> int:
    """The place where the draws' own numbers show most that pdf lacks; where u[2] chooses, which
    costs more to know, of some of the places."""
    lobes = chooses(at.case, at.case.theta_o_deg[0] if at.case.theta_o_deg else 45.0)
    index = at.some if lobes else np.arange(len(at.points.wo))
    return int(index[np.argmax(sure(_deficits(at, index, lobes)))])


def worst_of(places: Iterable[tuple[Case, float]]) -> tuple[Case, float]:
    """The place where looks, each with all roots, show most that pdf lacks."""

    def seen(place: tuple[Case, float]) -> float:
        case, theta = place
        return _lack(case, theta, look(case, theta)).estimate.mean

    return max(places, key=seen)


def _deficits(at: Survey, index: Index, lobes: bool) -> Array:
    """(places, replicates) of the mean of (1 - pdf/density)+ by the draws' own numbers alone."""
    size = REPLICATES_EACH * at.case.budget(DRAWS_EACH // REPLICATES_EACH)
    many = np.repeat(index, size)
    u = np.tile(inner(at.case.random(NAME, "survey"), size), (len(index), 1))
    wo, sets = at.points.wo[many], at.at.sets.at(many)

    def draw(numbers: Array) -> Array:
        return np.column_stack(draws_of(at.model, wo, numbers, sets))

    w = draw(u)[:, :3]
    area = tangents(draw, u, Piece(0.0, 1.0)).area / (extents(draw, u) if lobes else 1.0)
    usable = np.isfinite(w).all(axis=1) & (w[:, 2] > 0.0) & (area > 0.0)
    pdf = values_of(at.model, _pdf(at.model), wo, np.where(usable[:, None], w, wo), sets)
    lost = np.clip(np.where(usable & np.isfinite(pdf), 1.0 - pdf * area, 0.0), 0.0, 1.0)
    found: Array = lost.reshape(len(index), REPLICATES_EACH, -1).mean(axis=2)
    return found
