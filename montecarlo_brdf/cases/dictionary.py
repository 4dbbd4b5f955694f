"""Values at which a model's code may turn another way: its own numbers, and what is made of them.

A constant c of the code, one step and 0.1 % to either side of it, is tried as the value of every
parameter, cosine, angle, product of directions and number u; and so are equal parameters, whole
numbers and the ends of ranges. This only chooses points: it refutes nothing by itself.
It cannot see: relations of several numbers (cases.margins can), numbers beyond the first 48.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import Case, search_range
from montecarlo_brdf.cases.code import numbers_in
from montecarlo_brdf.cases.directions import HIGHEST_COSINE, MIRROR
from montecarlo_brdf.cases.points import Points, direction, even

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index

APART = (0.0, 1e-9, 1e-4, -1e-4, 5e-4, 1e-2)  # relative distances of nearly equal parameters
WHOLE = 16  # whole numbers of a range, from its low end
BOTH = 0.5  # share of the points that get a second special value
PREPARED = 32  # parameter sets besides the special ones, where the model prepares them


class Place(StrEnum):
    """What takes a value."""

    PARAMETER = "{name} = {value:.10g}"
    RATIO = "{name} = {other} (1 + {value:g})"
    SUM = "{name} + {other} = {value:g}"
    PRODUCT = "{name} = {value:g} {other}"
    COSINE_O = "wo.z = {value:.10g}"
    COSINE_I = "wi.z = {value:.10g}"
    AXIS_O = "wo.{xy} = {value:.10g}"
    AXIS_I = "wi.{xy} = {value:.10g}"
    NUMBER = "u[{axis}] = {value:.10g}"
    AZIMUTH_O = "phi_o = {value:.10g}"
    AZIMUTH_I = "phi_i = {value:.10g}"
    TURN = "phi_i - phi_o = {value:.10g}"
    DOT = "wo.wi = {value:.10g}"
    HALF = "n.h = {value:.10g}"
    HALF_DOT = "wo.h = {value:.10g}"
    SAME = "wi = wo"
    MIRROR = "wi = mirror direction of wo"


class Special(NamedTuple):
    """A value, what takes it, and which parameter, number or axis is meant."""

    place: Place
    value: float = 0.0
    axis: int = 0
    other: int = 0

    def text(self, names: Sequence[str]) -> str:
        """In words, for findings."""
        known = dict(enumerate(names))
        said = self.place.format(
            name=known.get(self.axis), other=known.get(self.other), value=self.value,
            axis=self.axis, xy="xy"[self.axis % 2],
        ).replace(" (1 + 0)", "")  # fmt: skip
        return f"; found at {said}, which the code may ask for"


OF_PARAMETERS = (Place.PARAMETER, Place.RATIO, Place.SUM, Place.PRODUCT)
OF_WO = (Place.COSINE_O, Place.AXIS_O, Place.AZIMUTH_O)


def points(case: Case, each: int = 2, only: Iterable[Special] | None = None) -> Points:
    """`each` points for every special value, half of them with a second one."""
    chosen = list(specials(case) if only is None else only)
    n, rng = each * len(chosen), case.random("dictionary", each, len(chosen))
    at = even(case, n, "dictionary", each, prepared=PREPARED)
    first = np.repeat(np.arange(len(chosen)), each)
    second = np.where(rng.random(n) < BOTH, rng.integers(0, max(1, len(chosen)), n), -1)
    for which in (second, first):
        _put(case, at, chosen, which, rng)
    names = [case.model.labels.get(name, name) for name in case.one._fields]
    return at.labelled(first, [special.text(names) for special in chosen])


def specials(case: Case) -> Iterator[Special]:
    """All special values of a case."""
    numbers = numbers_in(case.model)
    yield from of_parameters(case, numbers)
    yield from of_directions(numbers)
    beside = {v for c in numbers if c < 1.0 for v in (*_near(c), *_near(1.0 - c))}
    for value in sorted(v for v in beside | {0.25, 0.5, 0.75} if 0.0 < v < 1.0):
        yield from (Special(Place.NUMBER, value, axis) for axis in range(3))


def of_parameters(case: Case, numbers: Sequence[float]) -> Iterator[Special]:
    """Values and relations of free parameters."""
    names = case.one._fields
    for name in case.free:
        k, (low, high) = names.index(name), search_range(case.model, name) or (0.0, 0.0)
        made = {v for c in numbers for v in (1.0 / c, c * c, math.sqrt(c), 1.0 - c)}
        made |= {v for c in numbers for s in (c, -c) for v in _near(s)}
        whole = range(math.ceil(low), math.floor(min(high, low + WHOLE)) + 1)
        made |= {low, high, float(getattr(case.one, name)), *map(float, whole)}
        counted = name in case.model.whole
        made = {v for v in made if low <= v <= high and (v % 1.0 == 0.0 or not counted)}
        yield from (Special(Place.PARAMETER, v, k) for v in sorted(made))
        for j in range(0 if counted else len(names)):
            if j != k:
                yield from (Special(Place.RATIO, apart, k, j) for apart in APART)
                yield from (Special(Place.SUM, 1.0, k, j), Special(Place.PRODUCT, -1.0, k, j))


def of_directions(numbers: Sequence[float]) -> Iterator[Special]:
    """Values of cosines, coordinates, azimuths and products."""
    made = {v for c in numbers for d in _cosines(c) for v in _near(d)}
    for value in sorted({v for v in made if HIGHEST_COSINE <= v <= 1.0} | {0.5, 0.5**0.5, 1.0}):
        yield from (Special(place, value) for place in (Place.COSINE_O, Place.COSINE_I))
    sides = {v for c in numbers for v in (c, 0.999 * c, 1.001 * c) if v < 1.0} | {0.0}
    for value in sorted(sides | {-v for v in sides}):
        for place in (Place.AXIS_O, Place.AXIS_I):
            yield from (Special(place, value, axis) for axis in (0, 1))
        yield from (Special(Place.DOT, value), Special(Place.TURN, math.acos(value)))
    cosines = {v for c in numbers for v in (c, math.cos(c), math.cos(math.radians(c)))}
    for value in sorted(v for v in cosines if 0.0 < v <= 1.0):
        yield from (Special(Place.HALF, value), Special(Place.HALF_DOT, value))
    angles = {v for c in numbers for v in (c, math.radians(c)) if v <= math.pi}
    for value in sorted(angles | {0.0, 0.25 * math.pi, 0.5 * math.pi, math.pi}):
        yield from (Special(p, value) for p in (Place.AZIMUTH_O, Place.AZIMUTH_I, Place.TURN))
        yield Special(Place.TURN, -value)
    yield from (Special(Place.SAME), Special(Place.MIRROR))


def _near(v: float) -> tuple[float, ...]:
    steps = math.nextafter(v, math.inf), math.nextafter(v, -math.inf)
    return (v, *steps, 0.999 * v, 1.001 * v, 0.99 * v, 1.01 * v, v - 1e-3, v + 1e-3)


def _cosines(c: float) -> Iterator[float]:
    """What a number may have to do with a cosine."""
    made = [c, 1.0 - c, c * c, 1.0 / c, math.sqrt(c), 1.0 / math.hypot(1.0, c), math.cos(c)]
    made += [math.sin(c), math.cos(math.radians(c)), math.sin(math.radians(c))]
    made += [math.sqrt(1.0 - c * c)] if c < 1.0 else []
    return (v for v in made if 0.0 < v <= 1.0)


def _put(
    case: Case, at: Points, chosen: Sequence[Special], which: Index, rng: np.random.Generator
) -> None:
    """Give points the special values of the places `which` (-1: none)."""
    kinds = np.array([*(special.place.name for special in chosen), ""])
    numbers = np.array([special[1:] for special in chosen], dtype=float).reshape(-1, 3)
    for place, put in PUT.items():
        (rows,) = np.nonzero(kinds[which] == place.name)
        if len(rows):
            value, axis, other = numbers[which[rows]].T
            put(case, at, rows, value, axis.astype(int), other.astype(int), rng)


Put = Callable[..., None]  # (case, points, rows, value, axis, other, rng): changes the rows


def _parameter(
    case: Case, at: Points, rows: Array, value: Array, axis: Array, *_: object
) -> None:
    at.table[rows, axis] = value


def _related(relation: Callable[[Array, Array], Array]) -> Put:
    """A parameter made of another one, where it lies in its range."""

    def put(
        case: Case, at: Points, rows: Array, value: Array, axis: Array, other: Array, *_: object
    ) -> None:
        ends = np.array([search_range(case.model, n) or (0.0, 0.0) for n in case.one._fields])
        found = relation(at.table[rows, other], value)
        inside = (found >= ends[axis, 0]) & (found <= ends[axis, 1])
        at.table[rows, axis] = np.where(inside, found, at.table[rows, axis])

    return put


def _cosine(side: str) -> Put:
    def put(_: Case, at: Points, rows: Array, value: Array, *more: object) -> None:
        w = getattr(at, side)
        w[rows] = direction(value, np.arctan2(w[rows, 1], w[rows, 0]))

    return put


def _axis(side: str) -> Put:
    """x or y exactly, the rest anywhere."""

    def put(
        _: Case, at: Points, rows: Array, value: Array, axis: Array, other: Array,
        rng: np.random.Generator,
    ) -> None:  # fmt: skip
        rest = np.sqrt(np.maximum(0.0, (1.0 - value) * (1.0 + value)))
        z = np.maximum(rest * rng.random(len(rows)), HIGHEST_COSINE)
        across = np.sqrt(np.maximum(0.0, (rest - z) * (rest + z)))
        w = getattr(at, side)
        w[rows, axis], w[rows, 1 - axis] = value, across * rng.choice((-1.0, 1.0), len(rows))
        w[rows, 2] = z

    return put


def _number(_: Case, at: Points, rows: Array, value: Array, axis: Array, *more: object) -> None:
    at.u[rows, axis] = value


def _azimuth(side: str) -> Put:
    def put(_: Case, at: Points, rows: Array, value: Array, *more: object) -> None:
        w = getattr(at, side)
        w[rows] = direction(w[rows, 2], value)

    return put


def _turn(_: Case, at: Points, rows: Array, value: Array, *more: object) -> None:
    start = np.arctan2(at.wo[rows, 1], at.wo[rows, 0])
    at.wi[rows] = direction(at.wi[rows, 2], start + value)


def _half(
    _: Case, at: Points, rows: Array, value: Array, axis: Array, other: Array,
    rng: np.random.Generator,
) -> None:  # fmt: skip
    wo, h = at.wo[rows], direction(value, 2.0 * np.pi * rng.random(len(rows)))
    _above(at, rows, 2.0 * np.sum(h * wo, axis=1)[:, None] * h - wo)


def _dot(cosine: Callable[[Array], Array]) -> Put:
    """wi at an angle to wo."""

    def put(
        _: Case, at: Points, rows: Array, value: Array, axis: Array, other: Array,
        rng: np.random.Generator,
    ) -> None:  # fmt: skip
        c, wo, across = cosine(value), at.wo[rows], rng.normal(size=(len(rows), 3))
        across -= np.sum(across * wo, axis=1)[:, None] * wo
        across /= np.linalg.norm(across, axis=1)[:, None]
        s = np.sqrt(np.maximum(0.0, (1.0 - c) * (1.0 + c)))
        _above(at, rows, c[:, None] * wo + s[:, None] * across)

    return put


def _above(at: Points, rows: Array, w: Array) -> None:
    """wi, where that is above the horizon."""
    above = w[:, 2] > HIGHEST_COSINE
    at.wi[rows[above]] = w[above]


def _centre(factor: Array) -> Put:
    def put(_: Case, at: Points, rows: Array, *more: object) -> None:
        at.wi[rows] = at.wo[rows] * factor

    return put


PUT: dict[Place, Put] = {
    Place.PARAMETER: _parameter,
    Place.RATIO: _related(lambda other, value: other * (1.0 + value)),
    Place.SUM: _related(lambda other, value: value - other),
    Place.PRODUCT: _related(lambda other, value: value * other),
    Place.COSINE_O: _cosine("wo"),
    Place.COSINE_I: _cosine("wi"),
    Place.AXIS_O: _axis("wo"),
    Place.AXIS_I: _axis("wi"),
    Place.NUMBER: _number,
    Place.AZIMUTH_O: _azimuth("wo"),
    Place.AZIMUTH_I: _azimuth("wi"),
    Place.TURN: _turn,
    Place.DOT: _dot(lambda value: value),
    Place.HALF: _half,
    Place.HALF_DOT: _dot(lambda value: 2.0 * value * value - 1.0),
    Place.SAME: _centre(np.ones(3)),
    Place.MIRROR: _centre(MIRROR),
}
