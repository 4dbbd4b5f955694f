"""Parameter sets to look at: the one asked about, and others from the interior of the ranges."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeVar

from montecarlo_brdf.cases.case import Case, Parameters, search_range
from montecarlo_brdf.estimate.places import Rows, rows_of
from montecarlo_brdf.sampling.points import sobol

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

T = TypeVar("T", float, "Array")

INTERIORS = 8
WIDE = 50.0  # a range whose ends differ by more than this factor is searched by its logarithm


def between(low: float, high: float, t: T) -> T:
    """A value at t in [0, 1] of a range, by its logarithm where the range is wide; or many."""
    if low > 0.0 and high > WIDE * low:
        t = (high / low) ** t
        return low * t
    if low == 0.0 and high > WIDE:
        t = (1.0 + high) ** t
        return t - 1.0
    return low + (high - low) * t


def share(low: float, high: float, value: float) -> float:
    """The t of a value: the inverse of `between`."""
    value = min(max(value, low), high)
    if low == high:
        return 0.0
    if low > 0.0 and high > WIDE * low:
        return math.log(value / low) / math.log(high / low)
    if low == 0.0 and high > WIDE:
        return math.log1p(value) / math.log1p(high)
    return (value - low) / (high - low)


def placed(case: Case, name: str, ends: tuple[float, float], t: T) -> T:
    """The value of a parameter at t in [0, 1] of its range; of counts and switches each has an
    equal share."""
    if name not in case.model.whole:
        return between(*ends, t)
    low, high = math.ceil(ends[0]), math.floor(ends[1])
    found = (low + (high - low + 1) * t) // 1.0
    return min(found, float(high)) if isinstance(found, float) else found.clip(low, high)


def at(case: Case, t: dict[str, float]) -> Parameters:
    """The case's parameter set with the free parameters at positions t in [0, 1]."""
    ranges = {n: search_range(case.model, n) for n in case.free}
    changed = {n: float(placed(case, n, ends, float(t[n]))) for n, ends in ranges.items() if ends}
    return case.one._replace(**changed)


def table(case: Case, t: Array) -> Array:
    """(n, parameters): the sets that `at` makes of (n, free parameters) positions."""
    import numpy as np

    found = np.tile(np.array(tuple(case.one), dtype=float), (len(t), 1))
    for k, name in enumerate(case.free):
        ends = search_range(case.model, name) or (0.0, 0.0)
        found[:, case.one._fields.index(name)] = placed(case, name, ends, t[:, k])
    return found


def rows(case: Case, t: Array) -> Rows:
    """The same as a kernel takes them."""
    return rows_of(case.model, case.one, table(case, t))


def position(case: Case, p: Parameters) -> dict[str, float]:
    """Where a parameter set lies in the ranges: the inverse of `at`."""
    ranges = {n: search_range(case.model, n) or (0.0, 1.0) for n in case.free}
    return {n: _share(case, n, ends, getattr(p, n)) for n, ends in ranges.items()}


def _share(case: Case, name: str, ends: tuple[float, float], value: float) -> float:
    if name not in case.model.whole:
        return share(*ends, value)
    low, high = math.ceil(ends[0]), math.floor(ends[1])
    return (value - low + 0.5) / (high - low + 1)


def sets(case: Case, count: int = INTERIORS) -> Iterator[Parameters]:
    """The channels asked about, then points of the interior (a Sobol set, the same every time)."""
    yield from case.sets
    yield from itertools.islice(sets_inside(case), case.budget(count))


def sets_inside(case: Case) -> Iterator[Parameters]:
    """Points of the interior without end; none if no parameter is free."""
    for k in itertools.count() if case.free else ():
        u = sobol(case.seed + 0x5EED, k)
        yield at(case, {n: u[i % 5] for i, n in enumerate(case.free)})


def extremes(case: Case) -> Iterator[Parameters]:
    """Each free parameter exactly at either end of its range, and at 0 and 1 where these lie
    inside, the others as they are; then all at their low ends and all at their high ones."""
    ranges = {name: search_range(case.model, name) or (0.0, 0.0) for name in case.free}
    for name, (low, high) in ranges.items():
        for value in (low, *(v for v in (0.0, 1.0) if low < v < high), high):
            yield case.one._replace(**{name: float(value)})
    for k in (0, 1) if len(ranges) > 1 else ():
        yield case.one._replace(**{name: float(both[k]) for name, both in ranges.items()})


#: polar angle and azimuth in degrees, for the k-th of the cases elsewhere
PLACES = ((45.0, 130.0), (70.0, 250.0), (30.0, 20.0), (55.0, 200.0), (75.0, 310.0))


def elsewhere(case: Case) -> Iterator[tuple[Case, float]]:
    """The case turned, then other parameters at other angles: mistakes that defaults hide."""
    sets = [case.one, *itertools.islice(sets_inside(case), case.budget(len(PLACES) - 1))]
    for p, (theta, phi) in zip(sets, PLACES, strict=False):
        yield case._replace(p=p, phi_o_deg=case.phi_o_deg + phi), theta


def at_extremes(case: Case) -> Iterator[tuple[Case, float]]:
    """The case with parameters at the ends of their ranges, where clamps and guards act."""
    theta, phi = PLACES[0]
    for p in extremes(case):
        yield case._replace(p=p, phi_o_deg=case.phi_o_deg + phi), theta


def where(case: Case, theta_deg: float) -> dict[str, Any]:
    """The place of a case elsewhere, for a finding: its angles and its free parameters."""
    return {**case.where(theta_o_deg=theta_deg), **changed(case, case.one)}


def changed(case: Case, p: Parameters) -> dict[str, float]:
    """The free parameters of a set by name, for a finding's place."""
    return {case.model.labels.get(n, n): float(f"{getattr(p, n):.12g}") for n in case.free}


def unlike(case: Case, p: Parameters) -> str:
    """In words, in what a parameter set differs from the one asked about; nothing if in nothing."""
    usual = changed(case, case.one)
    differing = [f"{k} = {v:.4g}" for k, v in changed(case, p).items() if v != usual[k]]
    return f"not at the defaults, but with {', '.join(differing)}" if differing else ""
