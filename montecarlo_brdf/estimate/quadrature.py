"""Integrals over regions of directions: cells cut where they are rough, with an error measured.

A chart makes a square of the region. The square is cut into cells; in each the integrand is the
polynomial through Gauss's nodes. Cells are cut where two rules differ, and where probes, directions
at which f or a sky may be bright, have another value than the polynomial: so peaks are found, of
any width and wherever they are. What the polynomials leave is estimated by points at random in
every cell, without bias: the error is an interval of Student's t, not a bound that is guessed.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.estimate.regions import Chart
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.vectors import tangent_frame

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]
#: numbers (n,) of directions (n, 3)
OfArray = Callable[[Array], Array]
#: directions, and the solid angle that each stands for
Probes = tuple[Array, Array]

TAIL = 2  # coefficients of the highest degrees, which tell along which side a cell is rough
ALIKE = 4.0  # sides are both cut where one is rougher than the other by less
CUT = (0.1, 1e-3)  # of the error allowed: up to that rules must agree, at first and at last
SPARE = 0.5
HOPELESS = 0.125  # of all points, where even these are too few
ROUGHER = 10.0  # of it: what is left where no polynomial fits, and points alone decide
MOST_CELLS = 2000
MOST_POINTS = 1 << 21
BATCH = 1 << 16  # values in one call
REPLICATES, FEWEST = 32, 8
SURELY = 1e-9  # chance that the truth lies farther away than the error
LAST = 1.0 - 2.0**-53  # the last coordinate within the region
CORNER = 1.0 - 1e-9  # f need not be finite at the very ends of a region
ROUNDING = 1e-14
RINGS, SPOKES = 0.5 ** np.arange(1.0, 21.0), np.arange(8) * (np.pi / 4.0) + 0.2


class Integral(NamedTuple):
    """An integral, and how far it is from the truth at most."""

    value: float
    error: float


def integrate(
    function: OfArray,
    chart: Chart,
    target: float = 2.5e-6,
    probes: Sequence[Probes] = (),
    seed: int = 0,
) -> Integral:
    """Integral of function(wi) over a region, to a relative error of `target` where that can be.

    seed: another one moves all cells, nodes and points. What probes say that cells do not hold is
    part of the error.
    """
    rng = np.random.default_rng(seed)
    with np.errstate(all="ignore"):
        mesh = Mesh(Square(function, chart), probes, rng if seed else None)
        rest, error = mesh.estimated(rng, target)
    value = mesh.value + rest
    if not math.isfinite(value):
        return Integral(value, math.inf)
    return Integral(value, max(error, mesh.missed) + ROUNDING * abs(value))


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


class Rule(NamedTuple):
    """A rule on the unit square: nodes (n n, 2), weights, and the matrix from values along a side
    to coefficients of Legendre's polynomials."""

    nodes: Array
    weight: Array
    coefficients: Array


def _rule(nodes: NDArray[Any]) -> Rule:
    """The rule that integrates the polynomials through some nodes in (-1, 1) on each side."""
    made = np.linalg.inv(np.polynomial.legendre.legvander(nodes, len(nodes) - 1))
    side = 0.5 * (nodes + 1.0)
    return Rule(_products(side, side), np.outer(made[0], made[0]).ravel(), made)


@functools.cache
def _gauss(n: int) -> Rule:
    return _rule(np.polynomial.legendre.leggauss(n)[0])


@functools.cache
def _lobatto(n: int) -> Rule:
    """With nodes in the corners, which a step that cuts a cell parts."""
    inner = np.polynomial.legendre.Legendre.basis(n - 1).deriv().roots().real
    return _rule(np.array([-CORNER, *np.sort(inner), CORNER]))


class Cells(NamedTuple):
    """Rows of cells: where they begin and end, their integrals by two rules, and their polynomials:
    coefficients of Legendre's, (n, fine, fine)."""

    low: Array
    size: Array
    fine: Array
    coarse: Array
    polynomial: Array

    def part(self, which: Flags) -> Cells:
        """Some of them."""
        return Cells(*(column[which] for column in self))

    def joined(self, others: Cells) -> Cells:
        """All of both."""
        return Cells(*(np.concatenate(pair) for pair in zip(self, others, strict=True)))

    def at(self, places: Array, cell: Places) -> Array:
        """The polynomials at places (m, 2), each in the cell given."""
        n = self.polynomial.shape[1]
        inside = 2.0 * (places - self.low[cell]) / self.size[cell] - 1.0
        x, y = (np.polynomial.legendre.legvander(side, n - 1) for side in inside.T)
        found: Array = np.einsum("mi,mij,mj->m", x, self.polynomial[cell], y, optimize=True)
        return found

    @property
    def tails(self) -> Array:
        """(n, 2): what the highest degrees along either side make of the polynomials at most."""
        size = np.abs(self.polynomial)
        along = size[:, -TAIL:, :].sum(axis=(1, 2)), size[:, :, -TAIL:].sum(axis=(1, 2))
        return np.stack(along, axis=1)


class Mesh:
    """The cells of a square and the probes in them."""

    def __init__(
        self, square: Square, probes: Sequence[Probes], rng: np.random.Generator | None
    ) -> None:
        self._square = square
        x, y = square.edges(rng)
        self._cells = self._measured(_products(x[:-1], y[:-1]), _products(np.diff(x), np.diff(y)))
        wi = np.concatenate([np.zeros((0, 3)), *(wi for wi, _ in probes)])
        angle = np.concatenate([np.zeros(0), *(angle for _, angle in probes)])
        at = square.coordinates(wi)
        inside = ((at >= 0.0) & (at <= 1.0)).all(axis=1)
        self._at = at[inside]
        self._home = _place(x, self._at[:, 0]) * (len(y) - 1) + _place(y, self._at[:, 1])
        self._seen, area = square.both(*self._at.T)
        self._share = np.where(area > 0.0, angle[inside] / area, 0.0)
        self._beside = self._differences(np.ones(len(self._at), dtype=bool))

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
    def missed(self) -> float:
        """The integral that probes say to lie beside the polynomials."""
        return float(self._beside.sum())

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
            low, size, origin = _halves(low, size, halved, side, origin)
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
        fine, coarse = _gauss(many), _lobatto(few)
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

    def estimated(self, rng: np.random.Generator, target: float) -> tuple[float, float]:
        """What polynomials leave of the integral, and half the width of its interval."""
        many = max(FEWEST, min(REPLICATES, MOST_POINTS // len(self._cells.fine)))
        width = quantile(SURELY / 2.0, many - 1) / math.sqrt(many)
        for share in CUT:
            self.refine(share * target)
            left = self._left(rng, many, np.ones(len(self._cells.fine), dtype=int))
            rest, error = _interval(left, width)
            if not error > target * abs(self.value):
                return rest, error
        most = ROUGHER * target * abs(self.value)
        if not error > most or not math.isfinite(error) or self.value == 0.0:
            return rest, error
        # relative, as squares of large or small values are no numbers; spreads are known from few
        goal, spread = SPARE * ROUGHER * target / width, (left / self.value).std(axis=0, ddof=1)
        strata = _strata(spread, goal, MOST_POINTS / many)
        return _interval(self._left(rng, many, strata), width)

    def _left(self, rng: np.random.Generator, many: int, strata: Places) -> Array:
        """So many estimates of it in every cell, (many, cells), by points at random in `strata` by
        `strata` parts of each."""
        cells, number = self._cells, strata**2
        home = np.repeat(np.arange(len(number)), number)
        part = np.arange(len(home)) - (np.cumsum(number) - number)[home]
        corner = np.stack([part // strata[home], part % strata[home]], axis=1)
        together, n, found = max(1, BATCH // len(home)), len(number), []
        for k in range(0, many, together):
            at = rng.random((min(together, many - k), len(home), 2))
            at = (cells.low[home] + cells.size[home] * (corner + at) / strata[home, None])
            row = np.arange(len(at))[:, None] * n
            places, of = at.reshape(-1, 2), np.tile(home, len(at))
            left = self._square.both(*places.T)[0] - cells.at(places, of)
            found.append(np.bincount((row + home).ravel(), left, len(at) * n).reshape(-1, n))
        area: Array = cells.size.prod(axis=1) / number
        return np.concatenate(found) * area


def _interval(left: Array, width: float) -> tuple[float, float]:
    """The mean of estimates that are sums over cells, and half the width of its interval."""
    sums = left.sum(axis=1)
    size = float(np.abs(sums).max()) or 1.0  # squares of large or small values are no numbers
    return float(sums.mean()), width * size * float((sums / size).std(ddof=1))


def _strata(spread: Array, error: float, points: float) -> Places:
    """Parts along the sides of every cell, for a standard error of the sum of all and at most so
    many points.

    Of n points, one in each part of a cell that a step cuts, the spread of a mean falls like
    n^-3/4: then the fewest are needed where n goes like the spread of one to the 4/5.
    """
    each = spread**0.8
    needed, most = (float(each.sum()) / error**2) ** (2.0 / 3.0), points / float(each.sum())
    share = needed if needed < most else HOPELESS * most
    found: Places = np.maximum(1, np.ceil(np.sqrt(share * each))).astype(int)
    return found


def _products(x: Array, y: Array) -> Array:
    """All pairs, (n, 2)."""
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)


def _place(edges: Array, x: Array) -> Places:
    """Between which edges numbers lie."""
    found: Places = np.clip(np.searchsorted(edges, x, "right") - 1, 0, len(edges) - 2)
    return found


def _halves(
    low: Array, size: Array, halved: Flags, side: int, origin: Places
) -> tuple[Array, Array, Places]:
    """The cells with some halved along a side, the halves one after the other."""
    parent = np.repeat(np.arange(len(low)), 1 + halved)
    second = np.concatenate([[False], parent[1:] == parent[:-1]])
    low, size, origin = low[parent], size[parent], origin[parent]
    size[halved[parent], side] *= 0.5
    low[second, side] += size[second, side]
    return low, size, origin


def star(centre: Sequence[float] | Array) -> Probes:
    """Directions that come nearer to one by halves, on all sides, with the rings that they stand
    for: they see a lobe of any width there."""
    x, y, z = map(float, centre)
    t, b = (np.array(v) for v in tangent_frame((x, y, z)))
    angle, turn = (g.ravel() for g in np.meshgrid(RINGS, SPOKES, indexing="ij"))
    side = np.cos(turn)[:, None] * t + np.sin(turn)[:, None] * b
    wi = np.cos(angle)[:, None] * np.array(centre) + np.sin(angle)[:, None] * side
    above = wi[:, 2] > 0.0
    return wi[above], (1.5 * np.pi * angle * angle / len(SPOKES))[above]


def scale_of(wo: Array, wi: Array) -> float:
    """A slope below which few of the drawn directions lie."""
    h = np.asarray(wi) + np.asarray(wo)
    slopes = np.hypot(h[:, 0], h[:, 1]) / np.maximum(h[:, 2], 1e-300)
    if not len(slopes):
        return 1.0
    wide, sharp = np.quantile(slopes, (0.1, 1e-3))
    return float(min(0.3 * wide, 3.0 * sharp))  # differ where a sharp lobe is drawn now and then


@functools.lru_cache(maxsize=8)
def grid(nx: int, nb: int) -> tuple[Array, Array, Array]:
    """Gauss-Legendre in x, midpoints in b: nodes and weights, flattened."""
    node, weight = np.polynomial.legendre.leggauss(nx)
    b = (np.arange(nb) + 0.5) / nb
    x, bb = np.meshgrid(0.5 * (node + 1.0), b, indexing="ij")
    w = np.repeat(0.5 * weight / nb, nb)
    return x.ravel(), bb.ravel(), w
