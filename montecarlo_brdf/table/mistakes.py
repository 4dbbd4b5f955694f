"""What was probably done to a table that is off: what undone makes nearly all of it go away."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.table.accord import Truth
from montecarlo_brdf.table.axes import Axis, Placement, points
from montecarlo_brdf.table.interpolation import Interpolation, between

Array = NDArray[np.float64]
REST = 0.2  # of the deviations, root mean square, that may be left by what explains them


def likely(truth: Truth, cells: Array) -> str | None:
    """In words; None if nothing simple explains it."""
    exact = truth.cells.values
    before = _rms(cells - exact)
    if not before > truth.terms.target:
        return None
    tried = [(_rms(undone - exact) / before, words) for words, undone in _undone(truth, cells)]
    tried += list(_moved(truth, cells))
    rest, words = min(tried, default=(math.inf, ""))
    return words if rest < REST else None


def _rms(away: Array) -> float:
    return math.sqrt(float(np.mean(away * away)))


def _undone(truth: Truth, cells: Array) -> Iterator[tuple[str, Array]]:
    """The table with a mistake undone."""
    axes, names = truth.subject.axes, truth.subject.measures
    for k, axis in enumerate(axes):
        yield f"axis {axis.name} runs the other way", np.flip(cells, k + 1)
    for a, b in itertools.combinations(range(len(axes)), 2):
        if axes[a].size == axes[b].size:
            words = f"axes {axes[a].name} and {axes[b].name} are exchanged"
            yield words, np.swapaxes(cells, a + 1, b + 1)
    for a, b in itertools.combinations(range(len(names)), 2):
        order = [b if k == a else a if k == b else k for k in range(len(names))]
        yield f"{names[a]} and {names[b]} are exchanged", cells[order]
    own = float(np.sum(cells * cells))
    factor = float(np.sum(cells * truth.cells.values)) / own if own > 0.0 else 1.0
    if factor > 0.0:
        yield f"all values are {1.0 / factor:.6g} times what they should be", cells * factor


def _moved(truth: Truth, cells: Array) -> Iterator[tuple[float, str]]:
    """What is left of the deviations if the values lie where they would if an axis were placed the
    other way; asked where cells that are known lie on all sides."""
    axes, exact = truth.subject.axes, truth.cells.values
    for chosen in itertools.product((False, True), repeat=len(axes)):
        if not any(chosen):
            continue
        other = tuple(_other(a) if c else a for a, c in zip(axes, chosen, strict=True))
        places = np.array(list(points(other)))
        ends = np.array([(a.first, a.last) for a in axes]).T
        inside = ((places >= ends[0]) & (places <= ends[1])).all(axis=1).reshape(exact.shape[1:])
        found = between(exact, axes, places, Interpolation.CUBIC).reshape(exact.shape)
        which = " and ".join(a.name for a, c in zip(other, chosen, strict=True) if c)
        left = _rms((cells - found)[:, inside]) / _rms((cells - exact)[:, inside])
        yield left, f"its values lie at {other[chosen.index(True)].placement} of {which}"


def _other(axis: Axis) -> Axis:
    """From end to end instead of at centres, or the other way round."""
    edges = axis.placement is Placement.EDGES
    return axis._replace(placement=Placement.CENTRES if edges else Placement.EDGES)
