"""A square in cells, cut where a function is rough; what polynomials leave of it by points at
random, without bias.

Cells are cut where two rules differ, and where probes, directions at which f or a sky may be
bright, have another value than the polynomial. Where f has steps no polynomial fits: there the
points lie in parts of the cells, which are quartered where they make more of the error than others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.estimate.polynomials import Cells, gauss, halves, lobatto, products
from montecarlo_brdf.estimate.regions import Chart
from montecarlo_brdf.estimate.tree import Array, Flags, Places, Tree
from montecarlo_brdf.statistics import quantile

#: numbers (n,) of directions (n, 3)
OfArray = Callable[[Array], Array]
#: directions, and the solid angle that each stands for
Probes = tuple[Array, Array]

ALIKE = 4.0  # sides are both cut where one is rougher than the other by less
CUT = (0.1, 1e-3)  # of the error allowed: up to that rules must agree, at first and at last
SPARE = 0.5
ROUGHER = 10.0  # of it: what is left where no polynomial fits, and points alone decide
HOPELESS = 0.125  # of all points, where even these are too few
PILOT = 4  # points that tell how rough a part of a cell is
QUARTER = np.array([(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)])
MOST_CELLS = 2000
MOST_POINTS = 1 << 21
BATCH = 1 << 16  # values in one call
REPLICATES, FEWEST = 32, 8
SURELY = 1e-9  # chance that the truth lies farther away than the error
LAST = 1.0 - 2.0**-53  # the last coordinate within the region


class Square:
    """The integrand on the unit square of a chart."""

    def __init__(self, function: OfArray, chart: Chart) -> None:
        self._function, self.chart = function, chart

    def both(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The integrand per dx dy, and the solid angle."""
        wi, area = self.chart.directions(np.minimum(x, LAST), y)
        return self._function(wi) * area, area

    def coordinates(self, wi: Array) -> Array:
        """(x, y) of directions, (n, 2)."""
        return np.stack(self.chart.coordinates(wi), axis=1)

    def edges(self, rng: np.random.Generator | None) -> tuple[Array, Array]:
        """Of the first cells."""
        x, y = self.chart.edges
        return (_moved(x, rng), _moved(y, rng)) if rng and self.chart.movable else (x, y)


def _moved(edges: Array, rng: np.random.Generator) -> Array:
    """The edges, the inner ones at random up to half way to their neighbours."""
    room = 0.5 * np.minimum(edges[1:-1] - edges[:-2], edges[2:] - edges[1:-1])
    inner = edges[1:-1] + room * (2.0 * rng.random(len(room)) - 1.0)
    return np.concatenate([edges[:1], inner, edges[-1:]])


class Parts(NamedTuple):
    """A region in cells, with the integral over each."""

    low: Array  # (n, 2), of the square
    size: Array  # (n, 2)
    value: Array
    variance: Array  # of these values
    many: int  # estimates by which that is known
    missed: Array  # what probes say to lie beside the polynomials
    error: float  # how far the sum of all is from the truth at most
    nodes: Array  # of the tree that finds the cells
    node: Places  # of each cell


class Strata(NamedTuple):
    """Parts of cells, and of which each is."""

    low: Array
    size: Array
    home: Places

    def part(self, which: Flags) -> Strata:
        """Some of them."""
        return Strata(self.low[which], self.size[which], self.home[which])

    def joined(self, others: Strata) -> Strata:
        """All of both."""
        low, size = (np.concatenate(pair) for pair in zip(self[:2], others[:2], strict=True))
        return Strata(low, size, np.concatenate([self.home, others.home]))

    def quartered(self) -> Strata:
        """The quarters of all, those of one side by side."""
        half = np.repeat(0.5 * self.size, 4, axis=0)
        low = np.repeat(self.low, 4, axis=0) + half * np.tile(QUARTER, (len(self.home), 1))
        return Strata(low, half, np.repeat(self.home, 4))


class Mesh:
    """The cells of a square and the probes in them."""

    def __init__(
        self, square: Square, probes: Sequence[Probes], rng: np.random.Generator | None
    ) -> None:
        self._square = square
        x, y = square.edges(rng)
        self._cells = self._measured(products(x[:-1], y[:-1]), products(np.diff(x), np.diff(y)))
        self._tree = Tree(x, y)
        self._node = self._tree.first.ravel()
        wi = np.concatenate([np.zeros((0, 3)), *(wi for wi, _ in probes)])
        angle = np.concatenate([np.zeros(0), *(angle for _, angle in probes)])
        at = square.coordinates(wi)
        inside = ((at >= 0.0) & (at <= 1.0)).all(axis=1)
        self._at = at[inside]
        self._home = _place(x, self._at[:, 0]) * (len(y) - 1) + _place(y, self._at[:, 1])
        self._seen, area = square.both(*self._at.T)
        self._share = np.where(area > 0.0, angle[inside] / area, 0.0)
        self._beside = self._differences(np.ones(len(self._at), dtype=bool))
        self._farthest = np.zeros(len(self._home))  # what points have seen of what is left

    @property
    def _tails(self) -> Array:
        """How rough the polynomials are."""
        found: Array = self._cells.tails.sum(axis=1)
        return found

    @property
    def value(self) -> float:
        """The integral by the finer rule."""
        return float(self._cells.fine.sum())

    @property
    def missed(self) -> Array:
        """The integral that probes say to lie beside the polynomials, in each cell: where they have
        seen more than the points of the last estimates have."""
        home = self._home
        away = np.abs(self._seen - self._cells.at(self._at, home))
        beside = np.maximum(0.0, away - np.maximum(self._tails, self._farthest)[home]) * self._share
        found: Array = np.bincount(home, beside, len(self._tails)).astype(float)
        return found

    def refine(self, target: float) -> None:
        """Cut cells until rules and probes agree."""
        while len(self._cells.fine) < MOST_CELLS:
            rough = np.abs(self._cells.fine - self._cells.coarse)
            missed = np.bincount(self._home, self._beside, len(rough))
            allowed = target * abs(self.value)
            if not float((rough + missed).sum()) > allowed:
                break
            self._cut(rough + missed > 0.5 * allowed / len(rough), missed > rough)

    def _cut(self, which: Flags, unseen: Flags) -> None:
        """Halve cells along the sides that are rough, or along both where no node tells."""
        old, origin = self._cells, np.arange(len(which))
        low, size = old.low, old.size
        tails = old.tails
        rough = tails * ALIKE >= tails.max(axis=1)[:, None]
        sides = which[:, None] & (rough | unseen[:, None])
        for side in (0, 1):
            halved = sides[origin, side]
            middle = low[:, side] + 0.5 * size[:, side]
            beyond = halved[self._home] & (self._at[:, side] >= middle[self._home])
            self._home = np.cumsum(1 + halved)[self._home] - np.where(halved, 2, 1)[self._home]
            self._home += beyond
            self._node = self._tree.halved(self._node, halved, side, middle)
            low, size, origin = halves(low, size, halved, side, origin)
        new = which[origin]
        found, kept = self._measured(low[new], size[new]), old.part(~which)
        order = np.argsort(np.concatenate([np.flatnonzero(~new), np.flatnonzero(new)]))
        self._cells = Cells(*(column[order] for column in kept.joined(found)))
        moved = new[self._home]
        self._beside[moved] = self._differences(moved)

    def _differences(self, which: Flags) -> Array:
        """What some probes have seen farther from the polynomials than these are rough, times what
        they stand for."""
        home = self._home[which]
        away = np.abs(self._seen[which] - self._cells.at(self._at[which], home))
        found: Array = np.maximum(0.0, away - self._tails[home]) * self._share[which]
        return found

    def _measured(self, low: Array, size: Array) -> Cells:
        """New cells."""
        many, few = self._square.chart.nodes
        fine, coarse = gauss(many), lobatto(few)
        n, area = len(fine.coefficients), size.prod(axis=1)
        values, fewer = self._values(low, size, fine.nodes), self._values(low, size, coarse.nodes)
        square, c = values.reshape(-1, n, n), fine.coefficients
        polynomial = np.matmul(np.matmul(c, square), c.T)
        return Cells(low, size, area * (values @ fine.weight), area * (fewer @ coarse.weight),
                     polynomial)  # fmt: skip

    def _values(self, low: Array, size: Array, nodes: Array) -> Array:
        """At the nodes of cells, (cells, nodes)."""
        found = []
        for k in range(0, len(low), max(1, BATCH // len(nodes))):
            here = slice(k, k + max(1, BATCH // len(nodes)))
            at = low[here, None, :] + size[here, None, :] * nodes
            found.append(self._square.both(*at.reshape(-1, 2).T)[0])
        return np.concatenate(found).reshape(len(low), len(nodes))

    def lightened(self, share: float) -> bool:
        """Cut cells that hold more than a share of the integral; whether any did."""
        before = len(self._cells.fine)
        while len(self._cells.fine) < 2 * MOST_CELLS:
            heavy = self._cells.fine > share * self.value
            if not heavy.any():
                break
            self._cut(heavy, heavy)
        return len(self._cells.fine) > before

    def parts(self, left: Array) -> Parts:
        """The cells, with what polynomials leave of each."""
        cells, missed = self._cells, self.missed
        variance = left.var(axis=0, ddof=1) / len(left)
        error = max(interval(left)[1], float(missed.sum()))
        value = cells.fine + left.mean(axis=0)
        return Parts(cells.low, cells.size, value, variance, len(left), missed, error,
                     self._tree.nodes, self._node)  # fmt: skip

    def left(self, rng: np.random.Generator, target: float) -> Array:
        """Estimates of what polynomials leave of the integral over each cell, (many, cells)."""
        many = max(FEWEST, min(REPLICATES, MOST_POINTS // len(self._cells.fine)))
        for share in CUT:
            self.refine(share * target)
            left = self._left(rng, many, self._whole())
            error = interval(left)[1]
            if not error > target * abs(self.value):
                return left
        most = ROUGHER * target * abs(self.value)
        if not error > most or not math.isfinite(error) or self.value == 0.0:
            return left
        # relative, as squares of large or small values are no numbers; spreads are known from few
        goal = SPARE * ROUGHER * target / _width(many)
        spread = (left / self.value).std(axis=0, ddof=1)
        self._cells = self._cells.flattened(spread, self.value)
        return self._left(rng, many, self._strata(rng, spread, goal, MOST_POINTS // many))

    def _whole(self) -> Strata:
        return Strata(self._cells.low, self._cells.size, np.arange(len(self._cells.fine)))

    def _strata(self, rng: np.random.Generator, spread: Array, goal: float, most: int) -> Strata:
        """Parts of cells, for a standard error of the sum of all: those that make more of it than
        others are quartered, so that only what a step cuts gets small; the error falls like 1/n
        about, and where so even the most points are too few, few of them are drawn."""
        strata = self._whole()
        if SPARE * float(np.linalg.norm(spread)) * len(spread) > goal * most:
            most = int(HOPELESS * most)
        while len(spread) < most and float(np.linalg.norm(spread)) > goal:
            rough = spread**2 >= np.mean(spread**2)
            parts = strata.part(rough).quartered()
            seen = self._left_of(rng.random((PILOT, len(parts.home), 2)), parts) / self.value
            # few points may all lie on one side of a step
            least = np.repeat(spread[rough], 4) / 16.0
            found = np.maximum(seen.std(axis=0, ddof=1), least)
            strata = strata.part(~rough).joined(parts)
            spread = np.concatenate([spread[~rough], found])
        return strata

    def _left(self, rng: np.random.Generator, many: int, strata: Strata) -> Array:
        """So many estimates of it in every cell, (many, cells), by points at random in parts of
        these."""
        together, n, found = max(1, BATCH // len(strata.home)), len(self._cells.fine), []
        self._farthest = np.zeros(n)
        for k in range(0, many, together):
            left = self._left_of(rng.random((min(together, many - k), len(strata.home), 2)), strata)
            most = np.abs(left).max(axis=0) / strata.size.prod(axis=1)
            np.maximum.at(self._farthest, strata.home, most)
            at = np.arange(len(left))[:, None] * n + strata.home
            found.append(np.bincount(at.ravel(), left.ravel(), len(left) * n).reshape(-1, n))
        return np.concatenate(found)

    def _left_of(self, u: Array, strata: Strata) -> Array:
        """(k, n): the same in each part, by one place u (k, n, 2) in it."""
        places = (strata.low + strata.size * u).reshape(-1, 2)
        fitted = self._cells.at(places, np.tile(strata.home, len(u)))
        left = self._square.both(*places.T)[0] - fitted
        found: Array = left.reshape(len(u), -1) * strata.size.prod(axis=1)
        return found


def _width(many: int) -> float:
    """Half the width of an interval of so many estimates, in their standard deviations."""
    return quantile(SURELY / 2.0, many - 1) / math.sqrt(many)


def interval(left: Array) -> tuple[float, float]:
    """The mean of estimates that are sums over cells, and half the width of its interval."""
    sums = left.sum(axis=1)
    size = float(np.abs(sums).max()) or 1.0  # squares of large or small values are no numbers
    return float(sums.mean()), _width(len(left)) * size * float((sums / size).std(ddof=1))


def _place(edges: Array, x: Array) -> Places:
    """Between which edges numbers lie."""
    found: Places = np.clip(np.searchsorted(edges, x, "right") - 1, 0, len(edges) - 2)
    return found
