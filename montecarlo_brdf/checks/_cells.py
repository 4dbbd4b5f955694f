"""Groups of cells of about equal probability under a sampler's pdf.

The cells are those of the quadrature that finds all peaks of the density, wherever they are and
however narrow (estimate.quadrature), cut until none holds more than a group may; so each has a
probability with an error bar of its own.
"""

from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases.case import Case, pointwise
from montecarlo_brdf.checks._truth import AIM, probes
from montecarlo_brdf.estimate import cells
from montecarlo_brdf.estimate.mesh import Parts
from montecarlo_brdf.estimate.quadrature import parts
from montecarlo_brdf.estimate.regions import Coordinates
from montecarlo_brdf.estimate.tree import LEAF
from montecarlo_brdf.statistics import quantile

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array
    from montecarlo_brdf.estimate.tree import Places

GROUPS = 192
SHOWN = 1000  # cells of a picture
FINER = 0.25  # of a distance's tolerance for the mass: errors of groups add up to a larger distance
SURELY = 1e-9  # chance that probabilities are farther from the truth than is said
SIGMAS = 6.1  # standard errors of a normal that so seldom are exceeded on either side


def norm_bound(variance: Array, many: int) -> float:
    """What the norm of independent normal errors exceeds with probability SURELY at most, wider as
    Student's t is, since their variances are estimated by so many replicates.

    Source: Laurent, Massart 2000, "Adaptive estimation of a quadratic functional by model
    selection", lemma 1: P(sum a Z^2 > sum a + 2 |a| sqrt(x) + 2 max(a) x) <= exp(-x).
    """
    x, spread = math.log(1.0 / SURELY), float(np.linalg.norm(variance))
    square = float(variance.sum()) + 2.0 * spread * math.sqrt(x) + 2.0 * float(variance.max()) * x
    return quantile(SURELY / 2.0, many - 1) / SIGMAS * math.sqrt(square)


class Cells:
    """The cells of a density, for one direction."""

    def __init__(self, case: Case, theta: float, tolerance: float) -> None:
        self.model, self.p, self.wo = case.model, case.one, case.wo(theta)
        self.coordinates, self._target = Coordinates(self.wo), FINER * AIM * tolerance

    @functools.cached_property
    def parts(self) -> Parts:
        """The cells and their probabilities."""
        pdf, wo = pointwise(self.model, self.p).pdf, np.array(self.wo)
        seen = probes(self.model, self.p, self.wo)
        return parts(lambda wi: pdf(wo, wi), self.coordinates, self._target, seen, 1.0 / GROUPS)

    @property
    def mass(self) -> float:
        """The density's integral."""
        return float(self.parts.value.sum())

    @functools.cached_property
    def group(self) -> Places:
        """The group of each cell: runs of neighbours that hold as much as others."""
        value = np.maximum(self.parts.value, 0.0)
        middle = (np.cumsum(value) - 0.5 * value) / value.sum()
        run = np.minimum((GROUPS * middle).astype(int), GROUPS - 1)
        found: Places = np.unique(run, return_inverse=True)[1]
        return found

    @functools.cached_property
    def probability(self) -> Array:
        """Of each group, and last of a rejected draw."""
        each = np.bincount(self.group, np.maximum(self.parts.value, 0.0))
        return np.append(each, max(1.0 - self.mass, 0.0))

    @functools.cached_property
    def error(self) -> float:
        """How far the probabilities may be from the truth, as a distance of distributions."""
        each = np.maximum(self.probability[:-1], 1e-300)
        variance = np.bincount(self.group, self.parts.variance) / each
        missed = np.bincount(self.group, self.parts.missed) / np.sqrt(each)
        return norm_bound(variance, self.parts.many) + float(np.linalg.norm(missed))

    @functools.cached_property
    def numbers(self) -> Array:
        """The cells as compiled code reads them."""
        nodes = self.parts.nodes.copy()
        nodes[self.parts.node] = np.stack(
            [np.full(len(self.group), LEAF), *(self.group,) * 3], axis=1
        )
        return np.concatenate([self.coordinates.place, nodes.ravel()])

    def counts(self, key: int, samples: int, threads: int = 1) -> Array:
        """Draws in each group, and last those that were rejected or are not finite."""
        groups = len(self.probability) - 1
        return cells.counted(self.model, self.p, self.numbers, groups, key, samples, threads)

    def shown(self, counts: Array) -> dict[str, Any] | None:
        """Counts with the cells, for a picture: [x, x, b, b, probability, group], where b is the
        azimuth around the lobe's centre (a turn) and x the distance from it to the horizon; None
        if no eye would tell so many apart."""
        low, high = self.parts.low, self.parts.low + self.parts.size
        if len(low) > SHOWN:
            return None
        sides = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
        rows = zip(np.round(sides, 5).tolist(), self.parts.value, self.group, strict=True)
        cells = [[*side, float(f"{max(p, 0.0):.4g}"), int(k)] for side, p, k in rows]
        return {"counts": [int(n) for n in counts], "cells": cells}

    def about(self, group: int) -> tuple[float, float]:
        """The polar angle and azimuth in degrees of the heaviest cell of a group."""
        rows = np.flatnonzero(self.group == group)
        k = rows[int(np.argmax(self.parts.value[rows]))]
        x, b = self.parts.low[k] + 0.5 * self.parts.size[k]
        w = self.coordinates.directions(np.array([x]), np.array([b]))[0][0]
        return math.degrees(math.acos(min(1.0, w[2]))), math.degrees(math.atan2(w[1], w[0])) % 360.0
