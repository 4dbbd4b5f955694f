"""Cells of equal probability under a sampler's pdf, in coordinates that follow its lobe."""

from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks._draws import density_integral_of
from montecarlo_brdf.checks._truth import lobe_scale
from montecarlo_brdf.estimate import cells
from montecarlo_brdf.estimate.quadrature import Integral
from montecarlo_brdf.estimate.regions import Coordinates

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

COARSE, FINE, FINEST = (384, 256), (768, 512), (1536, 1024)  # grids of tabulated densities
JITTERED = 0x5EED  # the key of places at random in their squares
CELLS = cells.ROWS * cells.COLUMNS


class Cells:
    """Columns of equal probability by the pdf's marginal in azimuth, rows by its conditionals."""

    def __init__(self, case: Case, theta: float, size: tuple[int, int] = FINE) -> None:
        self.size = size
        self.model, self.p = case.model, case.one
        self.wo = np.array(case.wo(theta))
        self.coordinates = Coordinates(self.wo, lobe_scale(case.model, case.one, self.wo))

    @functools.cached_property
    def tables(self) -> tuple[Array, Array, float]:
        """(cumulated marginal in b, cumulated conditionals in x, total mass), midpoint rule."""
        density, _ = cells.tabulated(self.model, self.p, self.coordinates.place, self.size)
        density = density.reshape(self.size)
        columns = np.concatenate([np.zeros((1, self.size[1])), np.cumsum(density, axis=0)])
        marginal = np.concatenate([[0.0], np.cumsum(columns[-1])])
        return marginal, columns, float(marginal[-1])

    @functools.cached_property
    def jittered(self) -> Array:
        """The cells' probabilities by another grid, at random in each square."""
        place = self.coordinates.place
        density, wi = cells.tabulated(self.model, self.p, place, self.size, JITTERED)
        at = cells.placed(self.model, self.cut, wi)
        return np.bincount(at, weights=density, minlength=CELLS).astype(float)

    @functools.cached_property
    def integral(self) -> Integral:
        """Of the density, by a quadrature that finds its peaks wherever they are."""
        return density_integral_of(self.model, self.p, tuple(map(float, self.wo)))

    @property
    def error(self) -> float:
        """Distance between the cells' probabilities by the two grids: what a density with steps
        leaves unresolved; and what both have less, or more, than its integral, which may be of any
        cell."""
        each = self.tables[2] / CELLS
        grids = float(np.sqrt(np.sum((self.jittered - each) ** 2 / each)))
        return grids + self.lacking / math.sqrt(each)

    @property
    def lacking(self) -> float:
        """What the cells surely have less, or more, than the density's integral."""
        return max(0.0, abs(self.integral.value - self.tables[2]) - self.integral.error)

    @functools.cached_property
    def cut(self) -> cells.Cut:
        """The cells as compiled code reads them."""
        marginal, columns, mass = self.tables
        inside = (columns / np.maximum(columns[-1], 1e-300)).T
        rows = [edges(one, cells.ROWS) for one in inside]
        between = edges(marginal / mass, cells.COLUMNS)
        return cells.Cut(*self.size, np.concatenate([self.coordinates.place, between, *rows]))

    def counts(self, key: int, samples: int, threads: int = 1) -> Array:
        """Draws in each cell, and last those that were rejected or are not finite."""
        return cells.counted(self.model, self.p, self.cut, key, samples, threads)

    def shown(self, counts: Array) -> dict[str, Any]:
        """Counts with the edges of the cells, for a picture: in [0, 1], azimuth around the lobe's
        centre (a turn), then for each column between two of these the distance from the centre to
        the horizon, in the middle of the column."""
        nx, nb = self.size
        numbers = self.cut.numbers[cells.FIXED :]
        columns = np.clip(numbers[: cells.COLUMNS - 1], 0.0, nb)
        around = np.concatenate([[0.0], columns, [nb]])
        strips = numbers[cells.COLUMNS - 1 :].reshape(nb, cells.ROWS - 1)
        middle = np.minimum((0.5 * (around[:-1] + around[1:])).astype(int), nb - 1)
        rows = np.clip(strips[middle], 0.0, nx) / nx
        return {
            "counts": [int(n) for n in counts],
            "mass": float(self.tables[2]),
            "azimuth": np.round(around / nb, 5).tolist(),
            "distance": [[0.0, *np.round(row, 5).tolist(), 1.0] for row in rows],
        }

    @property
    def probability(self) -> Array:
        """Of each cell, and last of a rejected draw."""
        return np.array([self.tables[2] / CELLS] * CELLS + [self.rejected])

    @property
    def rejected(self) -> float:
        """The share of rejected draws by the density's integral."""
        return max(1.0 - self.integral.value, 0.0)


def edges(cumulated: Array, parts: int) -> Array:
    """Where a piecewise linear distribution, given at 0, 1, 2, ..., reaches k/parts; infinity if
    nowhere."""
    shares = np.arange(1, parts) / parts
    after = np.searchsorted(cumulated, shares)
    inner = np.minimum(after, len(cumulated) - 1)
    low, high = cumulated[inner - 1], cumulated[inner]
    reached = inner - 1 + (shares - low) / np.where(high > low, high - low, 1.0)
    return np.where(after < len(cumulated), reached, np.inf)
