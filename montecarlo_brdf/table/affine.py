"""Whether f = a + b f0: what a split sum takes for granted, asked at random places."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from montecarlo_brdf.estimate.places import parameter_rows, values_of
from montecarlo_brdf.model import channels
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.table.axes import Point, said
from montecarlo_brdf.table.subject import Subject

SETS, PAIRS = 64, 64  # parameter sets, and pairs of directions for each
ROUNDING = 1e-9  # of |f|


class Bend(NamedTuple):
    """How far f is from a straight line at most, relative to it, and where that is."""

    size: float
    where: dict[str, float]

    @property
    def straight(self) -> bool:
        """Whether rounding explains it."""
        return self.size <= ROUNDING


def bend(subject: Subject, seed: int = 0) -> Bend:
    """The largest deviation of f from the chord over two values of the split's parameter, at its
    low end and in between."""
    rng = np.random.default_rng(stream(seed, subject.model.identity, "affine"))
    worst = Bend(0.0, {})
    for _ in range(SETS):
        worst = max(worst, _bend(subject, rng), key=lambda b: b.size)
    return worst


def _bend(subject: Subject, rng: np.random.Generator) -> Bend:
    point: Point = tuple(
        a.first + rng.random() * (a.last - a.first) for a in subject.axes
    )
    place = subject.place(point)
    model, one = subject.model.of(place.p), channels(place.p)[0]
    name = next((n for n in one._fields if model.labels.get(n, n) == subject.split), subject.split)
    middle, high = subject.ends()
    low = max(2.0 * middle - high, model.domain.get(name, (0.0, 0.0))[0])
    between = low + rng.random() * (high - low)
    wo, wi = _directions(rng, PAIRS), _directions(rng, PAIRS)

    def f(value: float) -> np.ndarray:
        return values_of(model, model.f, wo, wi, parameter_rows(model, {name: value}, one, PAIRS))

    at_middle, slope = f(middle), (f(high) - f(middle)) / (high - middle)
    size = np.abs(at_middle) + np.abs(f(high))
    away = [(np.abs(f(x) - at_middle - (x - middle) * slope), x) for x in (low, between)]
    found = [(float(np.max(d / np.where(size > 0.0, size, 1.0))), x) for d, x in away]
    largest, x = max(found)
    return Bend(largest, {**said(subject.axes, point), subject.split: x})


def _directions(rng: np.random.Generator, n: int) -> np.ndarray:
    """Cosine-weighted ones."""
    u, v = rng.random(n), 2.0 * np.pi * rng.random(n)
    r = np.sqrt(u)
    return np.stack([r * np.cos(v), r * np.sin(v), np.sqrt(1.0 - u)], axis=1)
