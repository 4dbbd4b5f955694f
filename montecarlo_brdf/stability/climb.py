"""Worst-case search: from the worst points found, on to worse ones nearby."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.stability.arithmetic import Arithmetic, Array
from montecarlo_brdf.stability.designed import Points
from montecarlo_brdf.stability.errors import Errors, errors
from montecarlo_brdf.stability.ladder import Rung

NEIGHBOURS = 48


class Found(NamedTuple):
    """A point and how wrong the model is there."""

    wo: Any
    wi: Any
    p: NamedTuple
    value: float
    truth: float
    total: float
    own: float


def at(points: Points, p: NamedTuple, found: Errors, i: int) -> Found:
    """Point i of an evaluation."""
    numbers = (
        float(found.value[i]),
        float(found.truth[i]),
        float(found.total[i]),
        float(found.own[i]),
    )
    return Found(points.wo[i], points.wi[i], p, *numbers)


def climb(
    narrow: Rung, wide: Rung, start: Found, peers: Array, rounds: int, rng: np.random.Generator
) -> Found:
    """The worst of `rounds` rounds of neighbours, each around the worst so far.

    peers: the designed partners of start.wo, which say how large f gets: the neighbours keep wo and
    the parameters, so that they are judged by the same largest value.
    """
    best = start
    for _ in range(rounds):
        near = _neighbours(best.wi, narrow.arithmetic, rng)
        wi = np.concatenate([near, peers])
        points = Points(np.repeat(best.wo[None], len(wi), axis=0), wi, np.zeros(len(wi), dtype=int))
        found = errors(narrow, wide, points, start.p)
        i = int(np.argmax(found.own[: len(near)]))
        if found.own[i] > best.own:
            best = at(points, start.p, found, i)
    return best


def _neighbours(w: Array, arithmetic: Arithmetic, rng: np.random.Generator) -> Any:
    """Unit vectors around w, at distances from one rounding to a tenth, above the horizon."""
    size = 10.0 ** rng.uniform(np.log10(arithmetic.eps), -1.0, (NEIGHBOURS, 1))
    near = w.astype(np.float64) + size * rng.standard_normal((NEIGHBOURS, 3))
    near[:, 2] = np.abs(near[:, 2])
    near = arithmetic.array(near / np.linalg.norm(near, axis=1)[:, None])
    return near[near[:, 2] > 0]
