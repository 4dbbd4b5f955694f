"""Integrals over regions of directions: cells cut where they are rough, with an error measured.

A chart makes a square of the region, which is cut into cells (estimate.mesh): so peaks are found,
of any width and wherever they are. The error is an interval of Student's t, not a bound that is
guessed.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.estimate.mesh import Mesh, OfArray, Parts, Probes, Square, interval
from montecarlo_brdf.estimate.regions import Chart
from montecarlo_brdf.estimate.tree import Array
from montecarlo_brdf.vectors import tangent_frame

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
        rest, error = interval(mesh.left(rng, target))
    value = mesh.value + rest
    if not math.isfinite(value):
        return Integral(value, math.inf)
    return Integral(value, max(error, float(mesh.missed.sum())) + ROUNDING * abs(value))


def parts(
    function: OfArray, chart: Chart, target: float, probes: Sequence[Probes], share: float
) -> Parts:
    """The same in cells none of which holds more than a share of the integral."""
    rng = np.random.default_rng(0)
    with np.errstate(all="ignore"):
        mesh = Mesh(Square(function, chart), probes, None)
        left = mesh.left(rng, target)
        if mesh.lightened(share):
            left = mesh.left(rng, target)
        return mesh.parts(left)


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


@functools.lru_cache(maxsize=8)
def grid(nx: int, nb: int) -> tuple[Array, Array, Array]:
    """Gauss-Legendre in x, midpoints in b: nodes and weights, flattened."""
    node, weight = np.polynomial.legendre.leggauss(nx)
    b = (np.arange(nb) + 0.5) / nb
    x, bb = np.meshgrid(0.5 * (node + 1.0), b, indexing="ij")
    w = np.repeat(0.5 * weight / nb, nb)
    return x.ravel(), bb.ravel(), w
