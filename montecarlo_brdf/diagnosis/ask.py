"""A model at many rows of several parameter sets, in one call of a kernel that the checks have
compiled."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases.case import Parameters
from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.estimate.places import Rows, draws_of, rows_of, values_of
from montecarlo_brdf.model import Model

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

    #: a parameter set, wo and wi (or numbers u), one of them many
    Row = tuple[Parameters, Array, Array]


def asked(model: Model, function: Function, rows: Sequence[Row]) -> list[Array]:
    """f or pdf of every row: (n,) values each."""
    wo, wi, sets, ends = _joined(model, rows)
    return np.split(values_of(model, function, wo, wi, sets), ends)


def drawn(model: Model, rows: Sequence[Row]) -> list[tuple[Array, Array]]:
    """Directions (n, 3) and weights (n,) of every row."""
    if not rows:
        return []
    wo, u, sets, ends = _joined(model, rows)
    w, weight = draws_of(model, wo, u, sets)
    return list(zip(np.split(w, ends), np.split(weight, ends), strict=True))


def _joined(model: Model, rows: Sequence[Row]) -> tuple[Array, Array, Rows, list[int]]:
    pairs = [np.broadcast_arrays(np.atleast_2d(a), np.atleast_2d(b)) for _, a, b in rows]
    sizes = [len(a) for a, _ in pairs]
    table = np.array([tuple(p) for p, *_ in rows], dtype=float).reshape(len(rows), -1)
    sets = rows_of(model, rows[0][0], table).at(np.repeat(np.arange(len(rows)), sizes))
    a, b = (np.concatenate([pair[k] for pair in pairs]) for k in (0, 1))
    return a, b, sets, list(np.cumsum(sizes)[:-1])
