"""Derivatives of a sampler by the two numbers that place a direction, by central differences."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.estimate.pieces import Draw, Piece

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

#: of u in differences: rounding of directions, 2^-53, is then below 10^-10 of a difference
STEP = 1e-5
NEARBY = 1e-2  # of the distance to an end of [0, 1), at most: a pole's relative error is 1e-4/8
ROUNDING = 2.0**-50  # of a direction's coordinates
RESOLVED = 1e4  # times what rounding makes of an area: below, it is none


class Tangents(NamedTuple):
    """dw/du and dw/dv at n pairs of numbers."""

    first: Array  # (n, 3)
    second: Array
    noise: Array  # (n,) of their area, by rounding

    def at(self, rows: NDArray[np.intp]) -> Tangents:
        """Those of some rows."""
        return Tangents(self.first[rows], self.second[rows], self.noise[rows])

    @property
    def area(self) -> Array:
        """(n,) |dw/du x dw/dv|; 0 where rounding is all there is."""
        (x, y, z), (a, b, c) = self.first.T, self.second.T
        found = np.sqrt((y * c - z * b) ** 2 + (z * a - x * c) ** 2 + (x * b - y * a) ** 2)
        return np.where(found > RESOLVED * self.noise, found, 0.0)

    @property
    def length(self) -> Array:
        """(n,) how far the direction moves with the numbers."""
        return size(self.first) + size(self.second)

    def numbers(self, gap: Array) -> Array:
        """(n, 2) changes of the numbers that move the direction by gap (n, 3), to first order, in
        the sense of least squares; NaN where there are none."""
        aa, bb = dot(self.first, self.first), dot(self.second, self.second)
        ab = dot(self.first, self.second)
        ga, gb = dot(self.first, gap), dot(self.second, gap)
        with np.errstate(all="ignore"):
            det = np.where(self.area > 0.0, aa * bb - ab * ab, np.nan)
            return np.column_stack([(bb * ga - ab * gb) / det, (aa * gb - ab * ga) / det])


def tangents(draw: Draw, u: Array, piece: Piece, step: float = STEP) -> Tangents:
    """Of a piece, at numbers (n, 3)."""
    sides, noise = [], []
    for axis in piece.axes:
        low, high = piece.range(axis)
        h = np.minimum(step, NEARBY * np.minimum(u[:, axis] - low, high - u[:, axis]))
        ahead, behind = u.copy(), u.copy()
        ahead[:, axis] += h
        behind[:, axis] -= h
        width = ahead[:, axis] - behind[:, axis]
        with np.errstate(all="ignore"):
            sides.append((draw(ahead)[:, :3] - draw(behind)[:, :3]) / width[:, None])
            noise.append(ROUNDING / width)
    rounding = size(sides[0]) * noise[1] + size(sides[1]) * noise[0]
    return Tangents(sides[0], sides[1], rounding)


def dot(a: Array, b: Array) -> Array:
    """(n,) products; along the last axis NumPy's own sums are five times as slow."""
    found: Array = a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2]
    return found


def size(a: Array) -> Array:
    """(n,) lengths."""
    found: Array = np.sqrt(dot(a, a))
    return found
