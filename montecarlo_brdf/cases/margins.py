"""Points at, and on both sides of, every place where a model's code turns another way.

The plain functions run on numbers that record (arithmetic.recording). Where some points lie on one
side of a margin and some on the other, a number of one point (a parameter, a coordinate of a
direction, one of u) is exchanged for that of the other; where this changes the side, that number is
bisected to the last double. So `x == 0`, `a == 2 b` or a clamp at 88 degrees are met exactly. This
only chooses points: it refutes nothing by itself.
It cannot see: sides that no one number leads to from points that a short search finds; code that
cannot run on arrays.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.recording import Site, Tape, recording
from montecarlo_brdf.arithmetic.rung import Rung
from montecarlo_brdf.cases.case import Case, search_range
from montecarlo_brdf.cases.directions import HIGHEST_COSINE
from montecarlo_brdf.cases.points import Points, direction, even, joined
from montecarlo_brdf.estimate.places import rows_of

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Flags, Index

OPERATIONS = 60_000  # of arrays, per function: what searching in one may take
FIRST = 384  # points of the first look
SITES = 48  # per function, those with fewest points on one side first
PREPARED = 32  # parameter sets, where the model prepares them
FEW = 4  # points on a side that need no search
ROUNDS = 24  # of the search
NEAREST = 6  # points of a site whose numbers are changed in a round
POOL = 6000  # points that a search collects at most
PAIRS = 4  # points on either side that are tried, and brackets that are kept, of a site
PER_AXIS = 2  # of these, along one number
TRIALS = 1500
PASSES = 64  # of bisection: a double has 53 bits


class Side(Enum):
    """Where a number stands in a point."""

    TABLE = "table"
    WO = "wo"
    WI = "wi"
    U = "u"


class Axis(NamedTuple):
    """A number of a point: a parameter, one of u, or of a direction x, y, z or (3) the azimuth."""

    side: Side
    k: int

    def of(self, at: Points) -> Array:
        """Its values."""
        column: Array = getattr(at, self.side.value)
        return np.arctan2(column[:, 1], column[:, 0]) if self.k == 3 else column[:, self.k]

    def put(self, at: Points, value: Array) -> Points:
        """The points with other values."""
        column = getattr(at, self.side.value).copy()
        if self.side in (Side.WO, Side.WI):
            column = _redirected(column, self.k, value)
        else:
            column[:, self.k] = value
        return at._replace(**{self.side.value: column})


def _redirected(w: Array, k: int, value: Array) -> Array:
    """Unit vectors with another coordinate: x makes up for y, and both for z."""
    phi = np.arctan2(w[:, 1], w[:, 0])
    if k >= 2:
        return direction(w[:, 2], value) if k == 3 else direction(value, phi)
    value = np.clip(value, -1.0, 1.0)
    rest = (1.0 - value) * (1.0 + value)
    z = np.where(rest >= w[:, 2] ** 2, w[:, 2], np.sqrt(np.maximum(rest, HIGHEST_COSINE**2)))
    across = np.sqrt(np.maximum(rest - z * z, 0.0)) * np.where(w[:, 1 - k] < 0.0, -1.0, 1.0)
    columns = [value, across] if k == 0 else [across, value]
    return np.stack([*columns, z], axis=-1)


@functools.lru_cache(maxsize=8)
def points(case: Case) -> Points | None:
    """All crossings of f, pdf and sample: once for the points of values and the places of means."""
    members = [name for name in ("f", "pdf", "sample") if getattr(case.model, name)]
    found = [at for name in members if (at := Crossings(case, name).points()) is not None]
    return joined(found) if found else None


Margins = dict[Site, "Array"]


class Crossings:
    """Where one function of a model turns."""

    def __init__(self, case: Case, member: str) -> None:
        self.case, self.member = case, member
        self.tape = Tape(OPERATIONS)
        self.rung = Rung(replace(case.model, prepare=None), recording(self.tape))
        self.rng = case.random("margins", member)
        fields, second = case.one._fields, Side.U if member == "sample" else Side.WI
        free = [n for n in case.free if n not in case.model.whole]
        free = [] if case.model.prepare else free  # each new value would be prepared
        self.axes = [Axis(Side.TABLE, fields.index(name)) for name in free]
        self.axes += [Axis(Side.WO, k) for k in range(4)]
        self.axes += [Axis(second, k) for k in range(3 if second is Side.U else 4)]

    def points(self) -> Points | None:
        """The points of all crossings that are found, None if there are none."""
        try:
            at = even(self.case, FIRST, "margins", self.member, prepared=PREPARED)
            margins = self.asked(at)
            sites = sorted(margins, key=lambda site: _fewer(margins[site]))[:SITES]
            at, margins = self.searched(at, margins, sites)
            brackets = self.brackets(at, margins, sites)
            return self.bisected(brackets, sites) if brackets else None
        except Exception:  # a user's code, run on what it was not written for: it has the
            return None  # dictionary alone

    def asked(self, at: Points) -> Margins:
        """The margins of all sites at some points."""
        self.tape.begin(len(at.wo))
        second = at.u if self.member == "sample" else at.wi
        getattr(self.rung, self.member)(at.wo, second, self._parameters(at))
        return self.tape.margins

    def _parameters(self, at: Points) -> Any:
        """What the functions get, as arrays; `prepare` runs on plain numbers."""
        if self.case.model.prepare is None:
            return self.case.one._make(at.table.T)
        sets = rows_of(self.case.model, self.case.one, at.table)
        kind: Any = sets.shape[0] if sets.shape else tuple
        return kind._make(sets.numbers.T)  # nested ones and tables raise

    def searched(
        self, at: Points, margins: Margins, sites: Sequence[Site]
    ) -> tuple[Points, Margins]:
        """More points, nearer to the other side of sites that have few there."""
        margins = {site: margins[site] for site in sites}
        for k in range(ROUNDS):
            single = [site for site in sites if _fewer(margins[site]) < FEW]
            if not single or len(at.wo) > POOL or self.tape.left < OPERATIONS // 3:
                break
            more = joined([self._nearer(at, margins[site], k) for site in single])
            found = self.asked(more)
            nothing = np.full(len(more.wo), np.nan)
            margins = {s: np.concatenate([margins[s], found.get(s, nothing)]) for s in sites}
            at = _unlabelled(joined([at, more]))
        return at, margins

    def _nearer(self, at: Points, margin: Array, k: int) -> Points:
        """The points of the smallest margins, each with one of its numbers changed a little."""
        size = np.where(np.isfinite(margin) & (margin != 0.0), np.abs(margin), np.inf)
        some = np.argsort(size, kind="stable")[:NEAREST]
        start = at.at(np.repeat(some[np.isfinite(size[some])], 2))
        chosen = self.rng.permutation(len(self.axes))[:3]
        return joined([self._changed(start, self.axes[axis], k) for axis in chosen])

    def _changed(self, at: Points, axis: Axis, k: int) -> Points:
        """By a share that shrinks with the rounds: of its range, of itself, or of what it lacks of
        1."""
        value, n = axis.of(at), len(at.wo)
        step = 10.0 ** self.rng.uniform(-2.0 - k / 6.0, -k / 12.0, n)
        step *= self.rng.choice((-1.0, 1.0), n)
        low, high = self._ends(axis)
        ways = [value + step * (high - low), value * (1.0 + step)]
        ways += [value * np.abs(step), 1.0 - (1.0 - value) * np.abs(step)] if high == 1.0 else []
        moved = np.choose(self.rng.integers(0, len(ways), n), ways)
        return axis.put(at, np.clip(moved, low, high))

    def _ends(self, axis: Axis) -> tuple[float, float]:
        if axis.side is Side.TABLE:
            name = self.case.one._fields[axis.k]
            return search_range(self.case.model, name) or (0.0, 0.0)
        if axis.side is Side.U:
            return 1e-9, 1.0 - 1e-9
        return {2: (HIGHEST_COSINE, 1.0), 3: (-4.0, 4.0)}.get(axis.k, (-1.0, 1.0))

    def brackets(self, at: Points, margins: Margins, sites: Sequence[Site]) -> Brackets | None:
        """Points of a site, and the value of one of their numbers that leads to its other side."""
        trials = np.array(list(self._trials(margins, sites)), dtype=int).reshape(-1, 4)
        trials = trials[self.rng.permutation(len(trials))[:TRIALS]]
        site, axis, near, far = trials.T
        sign = np.array([np.sign(margins[sites[s]][k]) for s, k in zip(site, near, strict=True)])
        values = [np.zeros(len(trials)) for _ in range(2)]
        for k, one in enumerate(self.axes):
            for value, end in zip(values, (near, far), strict=True):
                value[axis == k] = one.of(at)[end[axis == k]]
        tried = Brackets(site, axis, at.at(near), values[0], values[1], sign)
        if not len(trials):
            return None
        there = self.margin_of(tried, sites, self.moved(tried, tried.far))
        kept = tried.at(_first(tried, np.isfinite(there) & (there * sign <= 0.0)))
        return kept if len(kept.site) else None

    def _trials(
        self, margins: Margins, sites: Sequence[Site]
    ) -> Iterator[tuple[int, int, int, int]]:
        """(site, axis, a point of one side, a point of the other)."""
        for k, site in enumerate(sites):
            sides = [np.flatnonzero(s * margins[site] > 0.0) for s in (1.0, -1.0)]
            if not all(map(len, sides)):
                continue
            for _ in range(PAIRS):
                one, other = (int(self.rng.choice(side)) for side in sides)
                for axis in range(len(self.axes)):
                    yield k, axis, one, other
                    yield k, axis, other, one

    def moved(self, b: Brackets, value: Array) -> Points:
        """The points of brackets with their number changed."""
        parts, order = [], []
        for k in range(len(self.axes)):
            rows = np.flatnonzero(b.axis == k)
            parts.append(self.axes[k].put(b.near.at(rows), value[rows]))
            order.append(rows)
        return _unlabelled(joined(parts).at(np.argsort(np.concatenate(order))))

    def margin_of(self, b: Brackets, sites: Sequence[Site], at: Points) -> Array:
        """The margin at each point of its bracket's site; NaN where it does not come by."""
        margins, nothing = self.asked(at), np.full(len(b.site), np.nan)
        table = np.array([margins.get(site, nothing) for site in sites])
        found: Array = table[b.site, np.arange(len(b.site))]
        return found

    def bisected(self, b: Brackets, sites: Sequence[Site]) -> Points:
        """The last doubles on either side of every site, and where its margin is exactly 0."""
        low, high, exact = b.low.copy(), b.far.copy(), np.full(len(b.site), np.nan)
        for _ in range(PASSES):
            middle = low + 0.5 * (high - low)
            live = (middle != low) & (middle != high) & np.isnan(exact)
            if not live.any() or self.tape.left < 0:
                break
            margin = self.margin_of(b, sites, self.moved(b, middle))
            exact[live & (margin == 0.0)] = middle[live & (margin == 0.0)]
            same = live & (margin * b.sign > 0.0)
            low = np.where(same, middle, low)
            high = np.where(live & ~same, middle, high)
        hit = np.flatnonzero(np.isfinite(exact))
        on = self.moved(b, np.where(np.isnan(exact), low, exact)).at(hit)
        ends = [self.moved(b, low), self.moved(b, high), on]
        labels = [f"; found where {site.text} turns" for site in sites]
        return joined(ends).labelled(np.concatenate([b.site, b.site, b.site[hit]]), labels)


class Brackets(NamedTuple):
    """Points, and for each a number of it between whose values a site turns."""

    site: Index  # (n,) places in a list of sites
    axis: Index  # places in the axes
    near: Points
    low: Array  # what the number is there
    far: Array  # what it is on the other side
    sign: Array  # of the margin at `near`

    def at(self, index: Index) -> Brackets:
        """Some of them."""
        rest = self.low[index], self.far[index], self.sign[index]
        return Brackets(self.site[index], self.axis[index], self.near.at(index), *rest)


def _first(b: Brackets, turned: Flags) -> Index:
    """The first brackets of each site that turn it, not all of them along one number."""
    kept: list[int] = []
    for k in np.flatnonzero(turned):
        same = [j for j in kept if b.site[j] == b.site[k]]
        along = sum(b.axis[j] == b.axis[k] for j in same)
        if len(same) < PAIRS and along < PER_AXIS:
            kept.append(int(k))
    return np.array(kept, dtype=int)


def _fewer(margin: Array) -> int:
    """How many points lie on the side of a site where fewer do."""
    return int(min(np.count_nonzero(margin < 0.0), np.count_nonzero(margin > 0.0)))


def _unlabelled(at: Points) -> Points:
    return at.labelled(np.zeros(len(at.wo), dtype=int), ("",))
