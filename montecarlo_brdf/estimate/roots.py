"""All pairs of numbers that give a direction: a sampler inverted at many draws, one call a step.

Newton's method from draws nearby. Neighbours are found along a Z-curve through the ranks of x and
y, which serves lobes of any width; those that are no neighbours halfway between their numbers
belong to another sheet of the map, and a search starts there. What is found starts others.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.estimate.pieces import Draw, Piece
from montecarlo_brdf.estimate.tangents import dot, size, tangents

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]
    Index = NDArray[np.intp]
    Words = NDArray[np.int64]

ITERATIONS = 10  # of Newton's method: each doubles the digits
SHORTER = 0.25  # times a step that led farther off
LONGEST = 0.25  # step of it
FOUND = 1e-7  # last step of one that arrived
APART = 1e-3  # between numbers that count as two roots: what is nearer counts once
FAR = 0.06  # between numbers that searches start from
SHEET = 0.5  # of the squared distance of neighbours on one sheet: the middle is so near to both
MOST = 6  # roots of a draw in a piece
ROUNDS = 4  # of searches from the roots of neighbours, at most
WORTH = 0.005  # of what was found first: a round that finds fewer is the last


class Roots(NamedTuple):
    """Numbers (m, 3) and whose they are: `row` counts the directions that were asked for."""

    u: Array
    row: Index


class Draws:
    """Draws of a sampler for one direction: `asked` of them first, and others to start from."""

    def __init__(self, draw: Draw, u: Array, asked: int) -> None:
        self.draw, self.u, self.asked = draw, u, asked
        self.w = draw(u)
        self.above = np.isfinite(self.w[:, :3]).all(axis=1) & (self.w[:, 2] > 0.0)
        #: share of the draws that are not above the horizon
        self.rejected = 1.0 - float(self.above.mean())

    @functools.cached_property
    def order(self) -> Index:
        """Those above the horizon, along the curve."""
        rows = np.flatnonzero(self.above)
        found: Index = rows[along_curve(self.w[rows])]
        return found

    def within(self, piece: Piece) -> Flags:
        """Which of those asked for lie in a piece, and above the horizon."""
        found: Flags = (piece.within(self.u) & self.above)[: self.asked]
        return found

    def neighbours(self, among: Flags, k: int) -> Index:
        """For each asked draw the |k|-th before it (k < 0) or after it on the curve, of some; -1 if
        there is none, or if the draw is not above the horizon."""
        place = np.flatnonzero(among[self.order])
        rank = np.searchsorted(place, np.arange(len(self.order)), side="left" if k < 0 else "right")
        at = rank + k if k < 0 else rank + k - 1
        inside = (at >= 0) & (at < len(place))
        found = np.full(len(self.u), -1, dtype=np.intp)
        if len(place):
            near = self.order[place[np.clip(at, 0, len(place) - 1)]]
            found[self.order] = np.where(inside, near, -1)
        return found[: self.asked]


def along_curve(w: Array) -> Index:
    """The order of directions on a Z-curve through the ranks of x and y."""
    code = np.zeros(len(w), dtype=np.int64)
    for axis in (0, 1):
        rank = np.empty(len(w), dtype=np.int64)
        rank[np.argsort(w[:, axis], kind="stable")] = np.arange(len(w)) * (1 << 16) // len(w)
        code |= _spread(rank) << axis
    found: Index = np.argsort(code, kind="stable")
    return found


def _spread(x: Words) -> Words:
    """Sixteen bits with a zero between each and the next."""
    for shift, mask in ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555)):
        x = (x | (x << shift)) & mask
    return x


def own_roots(pool: Draws, piece: Piece) -> Roots:
    """The draws' own numbers, of those that lie in a piece."""
    rows = np.flatnonzero(pool.within(piece))
    return Roots(pool.u[rows], rows)


class Search:
    """Numbers of a piece that give the draws that were asked for: the draws' own, of those that lie
    in it, and what is found."""

    def __init__(self, pool: Draws, piece: Piece) -> None:
        self.pool, self.piece = pool, piece
        mine = piece.within(pool.u) & pool.above
        #: (n, MOST, 3) roots, the draw's own first, NaN where there is none; how many there are
        self.u = np.full((pool.asked, MOST, 3), np.nan)
        self.own = pool.within(piece)
        self.u[self.own, 0] = pool.u[: pool.asked][self.own]
        self.count = self.own.astype(np.intp)
        near = {k: pool.neighbours(mine, k) for k in (-1, 1, -2, 2)}
        if not self.own.all():  # one root at least in another's piece
            for k in (-1, 1):
                self._from([(np.where(self.own, -1, near[k]), pool.u)])
        self._from([(rows, pool.u) for rows in near.values()])
        first = self._found()
        for _ in range(ROUNDS if first else 0):
            before = self._found()
            self._round()
            if self._found() - before <= WORTH * first:
                break

    def _found(self) -> int:
        return int(self.count.sum()) - int(self.own.sum())

    @property
    def roots(self) -> Roots:
        """All of them."""
        row, k = np.nonzero(~np.isnan(self.u[:, :, 0]))
        return Roots(self.u[row, k], row)

    def _round(self) -> None:
        """Search from the roots of neighbours."""
        asked, roots = np.arange(len(self.pool.u)) < self.pool.asked, self.u.copy()
        for k in (-1, 1):
            near = self.pool.neighbours(asked, k)
            self._from([(near, roots[:, j]) for j in range(int(self.count.max()))])

    def _from(self, starts: list[tuple[Index, Array]]) -> None:
        """Search from numbers of neighbours, where these lie on other sheets: all in one call a
        step, as each call has its price."""
        parts = [self._other(near, u) for near, u in starts]
        rows = np.concatenate([part.row for part in parts])
        begin = np.concatenate([part.u for part in parts])
        if not len(rows):
            return
        found = newton(self.pool.draw, self.piece, begin, self.pool.w[rows, :3])
        ends = np.cumsum([len(part.row) for part in parts])
        for low, high in zip([0, *ends[:-1]], ends, strict=True):
            here = (found.row >= low) & (found.row < high)
            self._add(Roots(found.u[here], rows[found.row[here]]))

    def _add(self, found: Roots) -> None:
        """One root at most for each row."""
        fresh = ~self._near(found.row, found.u, APART).any(axis=1) & (self.count[found.row] < MOST)
        rows = found.row[fresh]
        self.u[rows, self.count[rows]] = found.u[fresh]
        self.count[rows] += 1

    def _other(self, near: Index, u: Array) -> Roots:
        """Numbers of neighbours on other sheets than the roots that rows have, and the rows."""
        rows = np.flatnonzero((near >= 0) & ~np.isnan(u[near, 0]) & (self.count < MOST))
        begin, known = u[near[rows]], self._near(rows, u[near[rows]], FAR)
        same = self.own[rows] & self._straight(rows, near[rows], begin)
        known[:, 0] = np.where(self.own[rows], same, known[:, 0])
        other = ~known.any(axis=1)
        return Roots(begin[other], rows[other])

    def _straight(self, rows: Index, near: Index, u: Array) -> Flags:
        """Whether numbers of neighbours lie on the sheet of the draws' own: halfway between both
        pairs of numbers the direction lies between both directions, nearer to each."""
        middle = self.u[rows, 0]
        step = self._turned(rows, u)[:, 0]
        for k, axis in enumerate(self.piece.axes):
            low, high = self.piece.range(axis)
            x = middle[:, axis] + 0.5 * step[:, k]
            middle[:, axis] = np.mod(x, 1.0) if axis == 1 else np.clip(x, low, high)
        a, b, w = self.pool.w[rows], self.pool.w[near], self.pool.draw(middle)
        gap = SHEET * _square(a - b)
        return np.asarray((_square(w - a) < gap) & (_square(w - b) < gap))

    def _near(self, rows: Index, u: Array, distance: float) -> Flags:
        """(n, MOST): whether numbers of some rows lie as near to a root as that."""
        step = self._turned(rows, u)
        return np.stack([largest(step[:, j]) <= distance for j in range(step.shape[1])], axis=1)

    def _turned(self, rows: Index, u: Array) -> Array:
        """(n, roots, 2) from roots of some rows to numbers, on circles: azimuths close."""
        most, (first, second) = max(1, int(self.count.max())), self.piece.axes
        roots = self.u[rows, :most]
        step = np.stack([u[:, None, k] - roots[:, :, k] for k in (first, second)], axis=2)
        return np.asarray(step - np.rint(step))


def _square(a: Array) -> Array:
    """(n,) of the lengths of directions (n, 3 or more)."""
    return dot(a, a)


def largest(step: Array) -> Array:
    """(n,) of two numbers each, in size; NaN if one is."""
    return np.maximum(np.abs(step[:, 0]), np.abs(step[:, 1]))


def newton(draw: Draw, piece: Piece, begin: Array, target: Array) -> Roots:
    """Roots in a piece for directions (n, 3), from numbers (n, 3) each: those that were reached. A
    step that leads farther off, as across a seam of the map, is taken again at a quarter."""
    u, row, part = begin.copy(), np.arange(len(begin)), np.ones(len(begin))
    gap = target - draw(u)[:, :3]
    parts: list[tuple[Array, Index]] = []
    for _ in range(ITERATIONS):
        step = tangents(draw, u, piece).numbers(gap)
        length = largest(step)
        to = _moved(piece, u, part[:, None] * step)
        ahead = target[row] - draw(to)[:, :3]
        nearer = (size(ahead) < size(gap)) | (length < FOUND)
        u, gap = np.where(nearer[:, None], to, u), np.where(nearer[:, None], ahead, gap)
        part = np.where(nearer, 1.0, SHORTER * part)
        arrived = length < FOUND
        parts.append((u[arrived], row[arrived]))
        on = np.isfinite(length) & ~arrived
        u, row, part, gap = u[on], row[on], part[on], gap[on]
        if not len(row):
            break
    reached = np.concatenate([numbers for numbers, _ in parts])
    row = np.concatenate([rows for _, rows in parts])
    off = size(draw(reached)[:, :3] - target[row])
    kept = off <= FOUND * np.minimum(tangents(draw, reached, piece).length, 1.0)  # not at a seam
    return Roots(reached[kept], row[kept])


def _moved(piece: Piece, u: Array, step: Array) -> Array:
    """The numbers after a step: round a circle where u[1] leaves [0, 1), halfway to the end where
    another does."""
    u = u.copy()
    for k, axis in enumerate(piece.axes):
        low, high = piece.range(axis)
        x = u[:, axis]
        to = x + np.clip(np.nan_to_num(step[:, k]), -LONGEST, LONGEST)
        to = np.mod(to, 1.0) if axis == 1 else to
        to = np.where(to <= low, 0.5 * (x + low), to)
        u[:, axis] = np.where(to >= high, 0.5 * (x + high), to)
    return u
