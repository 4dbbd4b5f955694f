"""One model through the ladder: the worst error per precision, what broke, what is still safe."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.rung import Rung, rounded
from montecarlo_brdf.arithmetic.types import Arithmetic, Array, exact, wider
from montecarlo_brdf.model import Model
from montecarlo_brdf.stability import designed, sampling
from montecarlo_brdf.stability.designed import Points
from montecarlo_brdf.stability.errors import Errors, errors

#: Points per parameter set that are compared with 50 digits too: the worst, and every so many.
EXACT_WORST, EXACT_EVERY = 4, 499
#: Points per parameter set of a type whose only truth is 50 digits, and with `quick`.
MOST_EXACT, FEW_EXACT = 60, 20
CLIMBS, ROUNDS = 6, 12
FEW_CLIMBS, FEW_ROUNDS = 2, 4
NEIGHBOURS = 48  # points around the worst one, in each round of a climb
FARTHEST = 0.1  # of these from it
KINDS = ("nan", "inf", "negative", "flushed")


class Found(NamedTuple):
    """A point and how wrong the model is there."""

    wo: Array
    wi: Array
    p: NamedTuple
    value: float
    truth: float
    total: float
    own: float


@dataclass
class Loss:
    """What one precision loses of a model."""

    precision: str
    tolerance: float
    eps: float
    points: int = 0
    exact_points: int = 0
    worst: Found | None = None  # by what its inputs do not explain
    worst_total: Found | None = None
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    counts_low: dict[str, int] = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    first: dict[str, Found] = field(default_factory=dict)
    safe: tuple[str, float] | None = None  # parameter, value from which on errors are tolerable
    sharpness: list[tuple[float, float]] = field(default_factory=list)  # (value, worst own error)
    heat: list[tuple[float, float, float]] = field(default_factory=list)  # (degrees, value, error)
    draws: sampling.Draws | None = None


def loss(
    model: Model,
    sets: Sequence[Any],
    arithmetic: Arithmetic,
    tolerance: float | None = None,
    quick: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Loss:
    """Stress one model in one precision over parameter sets; deterministic."""
    narrow, wide = Rung(model, arithmetic), Rung(model, wider(arithmetic))
    result = Loss(arithmetic.name, tolerance or arithmetic.tolerance, arithmetic.eps)
    candidates: list[tuple[Found, Array]] = []
    for i, p in enumerate(sets):
        q = rounded(p, arithmetic)
        if q is not None:
            candidates += _one_set(result, narrow, wide, p, q, quick)
        if progress:
            progress(0.7 * (i + 1) / len(sets))
    _climb_from(result, narrow, wide, candidates, quick)
    result.safe = _safe(result, model)
    result.draws = sampling.draws(model, list(sets)[:: 4 if quick else 1], arithmetic)
    if progress:
        progress(1.0)
    return result


def _one_set(
    result: Loss, narrow: Rung, wide: Rung, p: NamedTuple, q: NamedTuple, quick: bool
) -> list[tuple[Found, Array]]:
    """Evaluate the designed set of one parameter set; its worst points, to climb from."""
    points = designed.directions(narrow.arithmetic, designed.width_of(narrow.model, p), quick)
    if wide.arithmetic is exact():
        most = FEW_EXACT if quick else MOST_EXACT
        points = Points(*(c[:: -(-len(points.wi) // most)] for c in points))
    found = errors(narrow, wide, points, q)
    result.points += len(found.own)
    _count(result, points, q, found)
    name = designed.sharpness(narrow.model)
    if name:
        result.sharpness.append((float(getattr(p, name)), float(found.own.max(initial=0.0))))
        result.heat += _by_angle(points, found, float(getattr(p, name)))
    worst = [int(np.argmax(found.own)), int(np.argmax(found.total))]
    _keep(result, *(at(points, q, found, i) for i in worst))
    if not quick and wide.arithmetic is not exact():
        _against_exact(result, narrow, points, q, found)
    peers = points.wi[points.group == points.group[worst[0]]]
    return [(at(points, q, found, worst[0]), peers)]


def _count(result: Loss, points: Points, q: NamedTuple, found: Errors) -> None:
    for kind, here in found.kinds.items():
        result.counts[kind] += int((here & ~found.low).sum())
        result.counts_low[kind] += int((here & found.low).sum())
        if kind not in result.first and (here & ~found.low).any():
            result.first[kind] = at(points, q, found, int(np.argmax(here & ~found.low)))


def _keep(result: Loss, *found: Found) -> None:
    for one in found:
        if result.worst is None or one.own > result.worst.own:
            result.worst = one
        if result.worst_total is None or one.total > result.worst_total.total:
            result.worst_total = one


def _by_angle(points: Points, found: Errors, value: float) -> list[tuple[float, float, float]]:
    """(theta_o in degrees, value, worst error) for every wo of the set."""
    starts = np.flatnonzero(np.r_[True, points.group[1:] != points.group[:-1]])
    worst = np.maximum.reduceat(found.own, starts)
    wo = points.wo[starts].astype(np.float64)
    theta = np.degrees(np.arctan2(np.hypot(wo[:, 0], wo[:, 1]), wo[:, 2]))
    return [(float(t), value, float(e)) for t, e in zip(theta, worst, strict=False)]


def _against_exact(
    result: Loss, narrow: Rung, points: Points, q: NamedTuple, found: Errors
) -> None:
    """The worst points and some others again, with 50 digits as truth."""
    order = np.argsort(found.own)[-EXACT_WORST:]
    chosen = np.unique(np.r_[order, np.arange(0, len(found.own), EXACT_EVERY)])
    chosen = chosen[~found.low[chosen]]
    few = Points(points.wo[chosen], points.wi[chosen], np.arange(len(chosen)))
    if not len(chosen):
        return
    again = errors(narrow, Rung(narrow.model, exact()), few, q)
    result.exact_points += len(chosen)
    # One point per group: its own |f| stands for the largest, which only makes eps |f| smaller.
    i = int(np.argmax(np.minimum(again.own, again.total)))
    if again.own[i] > found.own[chosen[i]] + 2 * narrow.arithmetic.eps:
        larger = found.truth[chosen[i]]
        relative = abs(float(again.truth[i]) - float(larger)) / abs(float(again.truth[i]))
        if relative > narrow.arithmetic.eps:  # the wider type is not the truth here
            _keep(result, at(few, q, again, i))


def _climb_from(
    result: Loss,
    narrow: Rung,
    wide: Rung,
    candidates: list[tuple[Found, Array]],
    quick: bool,
) -> None:
    rng = np.random.default_rng(7)
    ranked = sorted(candidates, key=lambda c: c[0].own, reverse=True)
    few = quick or wide.arithmetic is exact()  # every step costs 50 digits
    rounds = FEW_ROUNDS if quick else ROUNDS
    for found, peers in ranked[: FEW_CLIMBS if few else CLIMBS]:
        if np.isfinite(found.own):
            result.points += rounds * NEIGHBOURS
            _keep(result, climb(narrow, wide, found, peers, rounds, rng))


def _safe(result: Loss, model: Model) -> tuple[str, float] | None:
    """The sharpest value of the sharpness parameter up to which all smoother ones are tolerable."""
    name = designed.sharpness(model)
    worst: dict[float, float] = {}
    for value, error in result.sharpness:
        worst[value] = max(error, worst.get(value, 0.0))
    if name is None or not worst:
        return None
    widths = {v: designed.width_of(model, model.parameters()._replace(**{name: v})) for v in worst}
    safe = None
    for value in sorted(worst, key=lambda v: (-widths[v], -v)):
        if worst[value] > result.tolerance:
            break
        safe = value
    return (name, safe) if safe is not None else (name, float("nan"))


def at(points: Points, p: NamedTuple, found: Errors, i: int) -> Found:
    """Point i of an evaluation."""
    numbers = (float(one[i]) for one in (found.value, found.truth, found.total, found.own))
    return Found(points.wo[i], points.wi[i], p, *numbers)


def climb(
    narrow: Rung, wide: Rung, start: Found, peers: Array, rounds: int, rng: np.random.Generator
) -> Found:
    """The worst of `rounds` rounds of neighbours, each around the worst so far.

    peers: the designed partners of start.wo, which say how large f gets: the neighbours keep wo and
    the parameters, so that they are judged by the same largest value.
    """
    best = start
    for _ in range(rounds):
        near = _neighbours(best.wi, narrow.arithmetic, rng)
        wi = np.concatenate([near, peers])
        points = Points(np.repeat(best.wo[None], len(wi), axis=0), wi, np.zeros(len(wi), dtype=int))
        found = errors(narrow, wide, points, start.p)
        i = int(np.argmax(found.own[: len(near)]))
        if found.own[i] > best.own:
            best = at(points, start.p, found, i)
    return best


def _neighbours(w: Array, arithmetic: Arithmetic, rng: np.random.Generator) -> Array:
    """Unit vectors around w, at distances from one rounding to a tenth, above the horizon."""
    size = 10.0 ** rng.uniform(np.log10(arithmetic.eps), np.log10(FARTHEST), (NEIGHBOURS, 1))
    near = w.astype(np.float64) + size * rng.standard_normal((NEIGHBOURS, 3))
    near[:, 2] = np.abs(near[:, 2])
    near = arithmetic.array(near / np.linalg.norm(near, axis=1)[:, None])
    return near[near[:, 2] > 0]
