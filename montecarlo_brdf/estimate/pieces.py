"""Where a sampler's third number chooses: pieces of u[2] in which a draw is made one way.

Lines along u[2] at a few pairs (u[0], u[1]) show where the draw jumps. Between jumps one of the
three numbers must be idle, that is change nothing, or a direction belongs to a curve of numbers and
its density is no finite sum.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]

#: (n, 3) numbers -> (n, 4): directions and weights
Draw = Callable[["Array"], "Array"]

LINES = 8  # pairs (u[0], u[1]) at which u[2] is varied
STOPS = 64  # values of u[2] on each, at random within their 64ths, and both ends
END = 2.0**-30  # of [0, 1]: rare lobes lie at the ends
HALVINGS = 36  # of an interval with a jump: 2^-6 becomes less than APART
COARSE = 12  # halvings where an extent only chooses
APART = 1e-10  # between jumps of different lines that are one
MOST = 16  # jumps on a line, beyond which u[2] counts as a coordinate there
SAME = 1e-12  # between directions, and weights, that are one
TRIED = 64  # draws of a piece at which a number is found idle


class Piece(NamedTuple):
    """An interval of u[2] and the number that changes no draw within it: 0, 1 or 2."""

    low: float
    high: float
    idle: int = 2

    @property
    def share(self) -> float:
        """Of all draws."""
        return self.high - self.low

    @property
    def extent(self) -> float:
        """How much of the idle number gives the same draw."""
        return self.share if self.idle == 2 else 1.0

    @property
    def axes(self) -> tuple[int, int]:
        """The two numbers that place a direction."""
        first, second = (k for k in range(3) if k != self.idle)
        return first, second

    def range(self, number: int) -> tuple[float, float]:
        """From where to where a number runs in it."""
        return (self.low, self.high) if number == 2 else (0.0, 1.0)

    def placed(self, u: Array) -> Array:
        """(n, 2): those two of numbers (n, 3)."""
        first, second = self.axes
        return np.column_stack([u[:, first], u[:, second]])

    def within(self, u: Array) -> Flags:
        """Which numbers (n, 3) belong to it."""
        found: Flags = (u[:, 2] >= self.low) & (u[:, 2] < self.high)
        return found


def pieces(draw: Draw, rng: np.random.Generator) -> list[Piece] | str:
    """The pieces of a sampler for one direction, in order; or why there are none."""
    pairs = 0.1 + 0.8 * rng.random((LINES, 2))
    inner = (np.arange(STOPS) + rng.random((LINES, STOPS))) / STOPS
    ends = np.full((LINES, 1), END)
    stops = np.concatenate([ends, inner, 1.0 - ends], axis=1)
    line = np.repeat(pairs, STOPS + 2, axis=0)
    w = draw(np.column_stack([line, stops.ravel()])).reshape(LINES, STOPS + 2, 4)
    steps = ~_same(w[:, 1:], w[:, :-1])
    if not steps.any():
        return [Piece(0.0, 1.0)]
    if (steps.sum(axis=1) > MOST).any():
        return _as_coordinate(draw, rng)
    row, k = np.nonzero(steps)
    jumps = _bisected(draw, pairs[row], stops[row, k], stops[row, k + 1], w[row, k])
    return _between(draw, rng, jumps)


def _same(a: Array, b: Array) -> Flags:
    """Which draws (..., 4) are one; NaN is NaN."""
    with np.errstate(invalid="ignore"):
        close = (np.abs(a - b) <= SAME) | (np.isnan(a) & np.isnan(b))
    return close[..., 0] & close[..., 1] & close[..., 2] & close[..., 3]


def _bisected(draw: Draw, pairs: Array, low: Array, high: Array, before: Array) -> Array:
    """Where between two stops the draw stops being what it was before."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        held = _same(draw(np.column_stack([pairs, middle])), before)
        low, high = np.where(held, middle, low), np.where(held, high, middle)
    return high


def _between(draw: Draw, rng: np.random.Generator, jumps: Array) -> list[Piece] | str:
    """The pieces between jumps, if these are the same on all lines."""
    ordered = np.sort(jumps)
    edges = ordered[np.diff(ordered, prepend=-1.0) > APART]
    if len(edges) > MOST:
        return "the shares of its lobes depend on the other numbers"
    found = [Piece(float(a), float(b)) for a, b in zip([0.0, *edges], [*edges, 1.0], strict=True)]
    if all(_idle(draw, rng, piece, 2) for piece in found):
        return found
    return "the shares of its lobes depend on the other numbers"


def _as_coordinate(draw: Draw, rng: np.random.Generator) -> list[Piece] | str:
    """One piece in which u[0] or u[1] is idle, where u[2] is not."""
    for idle in (1, 0):
        piece = Piece(0.0, 1.0, idle)
        if _idle(draw, rng, piece, idle):
            return [piece]
    return "a direction belongs to curves of numbers: all three place it"


def _idle(draw: Draw, rng: np.random.Generator, piece: Piece, number: int) -> bool:
    """Whether a number changes no draw of a piece, from end to end."""
    low, high = piece.range(number)
    u = rng.random((TRIED, 3))
    u[:, 2] = piece.low + piece.share * u[:, 2]
    first, last = u.copy(), u.copy()
    first[:, number] = low + END * (high - low)
    last[:, number] = high - END * (high - low)
    w = draw(u)
    return bool((_same(w, draw(first)) & _same(w, draw(last))).all())


def extents(draw: Draw, u: Array) -> Array:
    """(n,) how far u[2] may move about the numbers (n, 3) before the draw changes."""
    w = draw(u)
    found: Array = _reach(draw, u, w, 1.0) - _reach(draw, u, w, 0.0)
    return found


def _reach(draw: Draw, u: Array, w: Array, end: float) -> Array:
    """Towards an end of [0, 1], by halving."""

    def held(third: Array) -> Flags:
        return _same(draw(np.column_stack([u[:, :2], third])), w)

    far, near = np.full(len(u), abs(end - END)), u[:, 2]
    whole = held(far)
    for _ in range(0 if whole.all() else COARSE):
        middle = 0.5 * (far + near)
        same = held(middle)
        near, far = np.where(same, middle, near), np.where(same, far, middle)
    return np.where(whole, end, near)
