"""Values between the cells of a table, as a texture unit or a shader takes them.

Beyond the outermost cells the nearest one counts, as with clamped textures.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.table.axes import Axis

Array = NDArray[np.float64]
Places = NDArray[np.integer[Any]]


class Interpolation(StrEnum):
    """How."""

    LINEAR = "linear"  # bilinear with two axes
    CUBIC = "cubic"  # Catmull and Rom's spline along every axis


#: the steps from the cell below to those that count, and their weights at t in [0, 1)
Weights = Callable[[Array], Array]


def _linear(t: Array) -> Array:
    return np.stack([1.0 - t, t])


def _cubic(t: Array) -> Array:
    """Catmull & Rom 1974, "A class of local interpolating splines", tension 1/2."""
    return 0.5 * np.stack([
        t * (t * (2.0 - t) - 1.0), t * t * (3.0 * t - 5.0) + 2.0,
        t * (t * (4.0 - 3.0 * t) + 1.0), t * t * (t - 1.0),
    ])  # fmt: skip


KINDS: dict[Interpolation, tuple[range, Weights]] = {
    Interpolation.LINEAR: (range(2), _linear),
    Interpolation.CUBIC: (range(-1, 3), _cubic),
}


def between(values: Array, axes: Sequence[Axis], at: Array, kind: Interpolation) -> Array:
    """Values (m, n) of m measures at n places (n, axes)."""
    steps, weights = KINDS[kind]
    rows = [_along(axis, at[:, k], steps, weights) for k, axis in enumerate(axes)]
    total = np.zeros((len(values), len(at)))
    for corner in itertools.product(range(len(steps)), repeat=len(axes)):
        index = tuple(cells[c] for c, (cells, _) in zip(corner, rows, strict=True))
        weight = np.prod([w[c] for c, (_, w) in zip(corner, rows, strict=True)], axis=0)
        total += weight * values[(slice(None), *index)]
    return total


def _along(axis: Axis, x: Array, steps: range, weights: Weights) -> tuple[Places, Array]:
    """Along an axis: the cells that count, (steps, n), and their weights."""
    place = np.clip((x - axis.first) / axis.step, 0.0, axis.size - 1.0)
    below = np.minimum(np.floor(place).astype(int), axis.size - 2)
    cells = np.clip(below + np.array(steps)[:, None], 0, axis.size - 1)
    return cells, weights(place - below)
