"""The points at which precision is lost: designed directions, parameters, and random numbers.

Directions are made in double and rounded component by component to the precision under test, as
data is; what must be exact there (the mirror of wo, one step beside it) is made in it.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.types import Arithmetic, Array
from montecarlo_brdf.model import Model

#: Polar angles in degrees that are nothing special, for both directions.
ANGLES = (15.0, 37.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.99)
#: Half vectors at these multiples of the lobe's width from the normal.
WIDTHS = (0.01, 0.1, 0.3, 1.0, 2.0, 4.0, 8.0, 30.0)
AZIMUTHS = 6
#: of the partners of a direction, in radians from it, beside one rounding of 0 and of a full turn
TURNS = (0.5, math.pi / 2, 2.0, math.pi - 1e-3, math.pi)
ASIDE = math.radians(37.0)  # azimuth of the view, nothing special, beside 0
WIDTH = 0.3  # of a lobe where a model declares none
WIDE = 50.0  # ratio of a range's ends from which its logarithm is stepped through
STEPS, FEW_STEPS, CORNERS = 9, 3, 16  # values of each parameter, and with `quick`; corners of all
Grid = list[tuple[float, float]]  # (sine, cosine) of polar angles


class Points(NamedTuple):
    """Pairs of directions in one precision; `group` numbers the wo that a pair belongs to."""

    wo: Array
    wi: Array
    group: Array


def polar(arithmetic: Arithmetic, quick: bool) -> Grid:
    """(sine, cosine) of polar angles from the normal to the last number above the horizon."""
    e = arithmetic.eps
    angles = ANGLES[::2] if quick else ANGLES
    ordinary = [(math.sin(math.radians(t)), math.sin(math.radians(90.0 - t))) for t in angles]
    at_normal = [(0.0, 1.0), (math.sqrt(e), 1.0), (e, 1.0), (arithmetic.tiny, 1.0)]
    at_horizon = [(1.0, e), (1.0, e * e), (1.0, arithmetic.tiny), (1.0, arithmetic.least)]
    return [*at_normal[:: 2 if quick else 1], *ordinary, *at_horizon]


@functools.lru_cache(maxsize=64)
def directions(arithmetic: Arithmetic, width: float, quick: bool = False) -> Points:
    """All designed pairs for a lobe of the given width (of half vectors or around the mirror)."""
    grid = polar(arithmetic, quick)
    turns = (0.0,) if quick else (0.0, ASIDE)
    wos = np.array([_at(s, c, phi) for s, c in grid for phi in turns])
    wos = arithmetic.array(wos)
    rows = [_partners(arithmetic, wo, grid, width) for wo in wos]
    sizes = [len(r) for r in rows]
    return Points(
        np.repeat(wos, sizes, axis=0), np.concatenate(rows), np.repeat(np.arange(len(wos)), sizes)
    )


def _at(s: float, c: float, phi: float) -> tuple[float, float, float]:
    return s * math.cos(phi), s * math.sin(phi), c


def _partners(arithmetic: Arithmetic, wo: Array, grid: Grid, width: float) -> Array:
    """Directions wi that may be trouble for this wo, all above the horizon."""
    double = wo.astype(np.float64)
    phi = math.atan2(double[1], double[0])
    rounded = [*_around(grid, phi, arithmetic.eps), *_reflections(double, width)]
    made = np.concatenate(
        [arithmetic.array(np.array(rounded)), np.array(list(_exact(arithmetic, wo)))]
    )
    return made[made[:, 2] > 0]


def _around(grid: Grid, phi: float, eps: float) -> Iterator[tuple[float, float, float]]:
    """The polar grid at azimuths in the plane, across it, nearly so, and about a full turn."""
    turns = (0.0, eps, *TURNS, 2 * math.pi * (1 - eps))
    for (s, c), turn in itertools.product(grid, turns):
        yield _at(s, c, phi + turn)


def _reflections(wo: Array, width: float) -> Iterator[Array]:
    """wo reflected by facets at multiples of the lobe's width."""
    for k, j in itertools.product(WIDTHS, range(AZIMUTHS)):
        turn = 2.0 * math.pi * (j + 0.1) / AZIMUTHS
        h = np.array([k * width * math.cos(turn), k * width * math.sin(turn), 1.0])
        h = h / np.sqrt(h @ h)
        yield 2.0 * (wo @ h) * h - wo


def _exact(arithmetic: Arithmetic, wo: Array) -> Iterator[Array]:
    """The mirror of wo, wo itself, across, the normal; each one rounding away, longer, shorter."""
    one = arithmetic.array(1.0)
    zero = arithmetic.array(0.0)
    mirror = np.array([-wo[0], -wo[1], wo[2]])
    across = np.array([-wo[1], wo[0], wo[2]])
    for w in (mirror, wo, across, np.array([zero, zero, one])):
        yield w
        for up, down in ((9.0, -9.0), (-9.0, 9.0)):
            yield np.nextafter(w, arithmetic.array([up, up, up]))
            for k in range(3):
                moved = w.copy()
                moved[k] = np.nextafter(w[k], arithmetic.array(down))
                yield moved
        least = w.copy()
        least[:2] = np.where(w[:2] == 0, arithmetic.array(arithmetic.least), w[:2])
        yield least


def width_of(model: Model, p: NamedTuple) -> float:
    """Width of the model's lobe as it declares it, or a width that is nothing special."""
    return float(model.lobe[1](p)) if model.lobe else WIDTH


def sharpness(model: Model) -> str | None:
    """The parameter that makes the lobe narrow, if the model has one: what a roughness is."""
    for name in model.domain if model.lobe else ():
        defaults = model.parameters()
        ends = [defaults._replace(**{name: end}) for end in model.domain[name]]
        widths = [width_of(model, end) for end in ends]
        if max(widths) > 2.0 * min(widths):
            return name
    if "alpha" in model.domain or "roughness" in model.domain:
        return "alpha" if "alpha" in model.domain else "roughness"
    return None


def steps(low: float, high: float, count: int) -> list[float]:
    """Values from low to high: by equal factors where the range is wide, else by equal steps."""
    if low > 0.0 and high / low > WIDE:
        return [min(high, low * (high / low) ** (k / (count - 1))) for k in range(count)]
    if low == 0.0 and high > WIDE:  # exponents: 0 and decades
        return [0.0, *(10.0 ** (k / 2) for k in range(-2, 1 + 2 * round(math.log10(high))))]
    inner = [low + (high - low) * k / (count - 1) for k in range(count)]
    return [inner[0], *([1e-6 * high, 1e-3 * high] if low == 0.0 else []), *inner[1:]]


def parameters(model: Model, quick: bool = False) -> list[Any]:
    """Verified sets, every parameter alone through its domain, and all corners of the domain."""
    base = model.parameters()
    found = [base, *(p for p in model.verified if type(p) is type(base))]
    for name, (low, high) in model.domain.items():
        values = steps(low, high, FEW_STEPS if quick else STEPS)
        found += [
            base._replace(**{name: v}) for v in values[:: 2 if quick and len(values) > 5 else 1]
        ]
    corners = itertools.islice(itertools.product(*model.domain.values()), CORNERS)
    found += [base._replace(**dict(zip(model.domain, c, strict=True))) for c in corners]
    return list(dict.fromkeys(found))


def uniforms(arithmetic: Arithmetic) -> Array:
    """Triples of random numbers a generator may give and a test never draws: ends and corners."""
    e = arithmetic.eps
    low = arithmetic.array([0.0, arithmetic.least, arithmetic.tiny, e / 2, 0.25, 0.5, 0.75])
    one = arithmetic.array(1.0)  # subtract in this type: in double 1 - 1e-19 is 1
    values = [*low, one - arithmetic.array(e), one - arithmetic.array(e / 2)]
    choices = [low[0], arithmetic.array(0.4), values[-1]]
    return np.array(list(itertools.product(values, values, choices)), dtype=arithmetic.dtype)
