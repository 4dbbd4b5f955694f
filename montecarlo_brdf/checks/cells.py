"""Cells of equal probability under a sampler's pdf, in coordinates that follow its lobe."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from montecarlo_brdf.checks.case import Case, pointwise
from montecarlo_brdf.checks.lobe_coordinates import Coordinates
from montecarlo_brdf.checks.truth import lobe_scale
from montecarlo_brdf.integration import counting

FINE = (768, 512)  # the grid on which the density is tabulated
COARSE = (384, 256)
CELLS = counting.ROWS * counting.COLUMNS


class Cells:
    """Columns of equal probability by the pdf's marginal in azimuth, rows by its conditionals."""

    def __init__(self, case: Case, theta: float, size: tuple[int, int] = FINE) -> None:
        self.size = size
        self.model, self.p = case.model, case.one
        self.wo = np.array(case.wo(theta))
        self.functions = pointwise(case.model, case.one)
        self.coordinates = Coordinates(self.wo, lobe_scale(case.model, case.one, self.wo))

    @functools.cached_property
    def tables(self) -> tuple[Any, Any, float]:
        """(cumulated marginal in b, cumulated conditionals in x, total mass), midpoint rule."""
        nx, nb = self.size
        x, b = (np.arange(nx) + 0.5) / nx, (np.arange(nb) + 0.5) / nb
        xx, bb = np.meshgrid(x, b, indexing="ij")
        density = self._density(xx, bb)[1].reshape(nx, nb)
        columns = np.concatenate([np.zeros((1, nb)), np.cumsum(density, axis=0)])
        marginal = np.concatenate([[0.0], np.cumsum(columns[-1])])
        return marginal, columns, float(marginal[-1])

    @functools.cached_property
    def error(self) -> float:
        """Distance between the cells' probabilities and those by another grid, at random in each
        square: what a density with steps leaves unresolved."""
        nx, nb = self.size
        jitter = np.random.default_rng(0).random((2, nx, nb))
        x = (np.arange(nx)[:, None] + jitter[0]) / nx
        b = (np.arange(nb)[None, :] + jitter[1]) / nb
        wi, density = self._density(x, b)
        cells = counting.placed(self.model, self.p, self.cut, wi)
        found = np.bincount(cells, weights=density, minlength=CELLS)
        each = self.tables[2] / CELLS
        return float(np.sqrt(np.sum((found - each) ** 2 / each)))

    def _density(self, x: Any, b: Any) -> tuple[Any, Any]:
        """Directions and the probability of each square of a grid."""
        wi, jacobian = self.coordinates.directions(x.ravel(), b.ravel())
        return wi, jacobian * self.functions.pdf(self.wo, wi) / x.size

    @functools.cached_property
    def cut(self) -> counting.Cut:
        """The cells as compiled code reads them."""
        marginal, columns, mass = self.tables
        place = (*self.wo, *self.coordinates.turn, self.coordinates.scale, mass)
        inside = (columns / np.maximum(columns[-1], 1e-300)).T
        return counting.Cut(*self.size, np.concatenate([place, marginal, inside.ravel()]))

    def counts(self, key: int, samples: int) -> Any:
        """Draws in each cell, and last those that were rejected or are not finite."""
        return counting.drawn(self.model, self.p, self.cut, key, samples)

    @property
    def probability(self) -> Any:
        """Of each cell, and last of a rejected draw."""
        mass = self.tables[2]
        return np.array([mass / CELLS] * CELLS + [max(1.0 - mass, 0.0)])
