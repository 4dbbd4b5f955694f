"""Ways to choose a direction: from a point u in [0, 1)^5 to (x, y, z, cos/pdf, 1/pdf).

A direction with z <= 0 was rejected by the model's sampler and counts as 0. `given` is the given
direction and a number that some of these use: the width of a lobe (charts), the side on which one
is looked for (slopes). `SAMPLE` and `PDF` are bound to a model's functions. Those that know nothing
of a model can be made for a whole block of points at once, some of them in steps: in one loop with
f their dependent operations add up to a chain that a processor with few vector registers waits for.
"""
from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.compile.bind import hole
from montecarlo_brdf.sampling import charts
from montecarlo_brdf.sampling.charts import Row
from montecarlo_brdf.sampling.slopes import FINEST, direction
from montecarlo_brdf.sampling.warps import random_hemisphere, random_hemisphere_cosine
from montecarlo_brdf.special import exp2, turn
from montecarlo_brdf.vectors import Vec

SAMPLE: Callable[..., tuple[float, ...]] = hole()
PDF: Callable[..., float] = hole()
STEEPEST: Callable[..., float] = hole()

PI, TWO_PI = math.pi, 2.0 * math.pi
Given = tuple[float, float, float, float]
#: the directions at which an integrand is probed
PROBES = 65
#: the most that `smooth_step` stretches a coordinate
STRETCH = 1.875


class Sampler(StrEnum):
    """The ways by name; the last four are charts of the hemisphere fitted to a model."""

    UNIFORM = "uniform"
    COSINE = "cosine"
    OWN = "own"
    HALF_VECTOR = "half_vector"
    MIRROR = "mirror"
    PANELS = "panels"
    SLOPES = "slopes"


def uniform(u: Row, given: Given) -> Row:
    """Uniform over the hemisphere, still without its weights."""
    return *random_hemisphere(u[0], u[1]), 0.0, 0.0, 0.0, 0.0, 0.0


def weighed_uniform(w: Row, given: Given) -> Row:
    """With them: what is known of the density need not lie in memory."""
    return w[0], w[1], w[2], w[2] * TWO_PI, TWO_PI, 0.0, 0.0, 0.0


def cosine(u: Row, given: Given) -> Row:
    """Cosine-weighted, still without its weights."""
    return *random_hemisphere_cosine(u[0], u[1]), 0.0, 0.0, 0.0, 0.0, 0.0


def weighed_cosine(w: Row, given: Given) -> Row:
    """With them."""
    return w[0], w[1], w[2], PI, PI / w[2], 0.0, 0.0, 0.0


def weighed(w: Row, given: Given) -> Row:
    """A direction that has its weights."""
    return w


def polar(u: Row, given: Given) -> Row:
    """The polar coordinates of a point in charts of lobes."""
    return *charts.polar(u[0], u[1]), 0.0, 0.0, 0.0


def half_horizon(u: Row, given: Given) -> Row:
    """These, and where half vectors end."""
    return charts.half_horizon(given[:3], u[:5])


def half_vector(u: Row, given: Given) -> Row:
    """The direction of a half vector."""
    x, y, z, area = charts.half_vector(given[:3], u, given[3])
    return x, y, z, z * area, area, 0.0, 0.0, 0.0


def mirror_horizon(u: Row, given: Given) -> Row:
    """Polar coordinates, and where the horizon is."""
    return charts.mirror_horizon(given[:3], u[:5])


def mirror(u: Row, given: Given) -> Row:
    """A direction around the mirror direction."""
    x, y, z, area = charts.mirror(given[:3], u, given[3])
    return x, y, z, z * area, area, 0.0, 0.0, 0.0


def panels(u: Row, given: Given) -> Row:
    """Two directions and their projected solid angles; two more lie opposite."""
    return charts.panels(given[:3], u[0], u[1])


def slopes(u: Row, given: Given) -> Row:
    """By slopes of the half vector with the given direction (given[3] > 0: a lobe at the mirror
    direction) or with its mirror image (< 0: a lobe at the direction itself); cosine-weighted where
    given[3] is 0."""
    if given[3] == 0.0:
        return weighed_cosine(cosine(u, given), given)
    side = 1.0 if given[3] > 0.0 else -1.0
    x, y, z, area = direction(u[0], u[1], (side * given[0], side * given[1], given[2]), FINEST)
    return x, y, z, z * area, area, 0.0, 0.0, 0.0


def own(u: Row, given: Given, p: Any) -> Row:
    """Drawn by the model's sampler, with its density."""
    wo = given[:3]
    w = SAMPLE(wo, (u[0], u[1], u[4]), p)
    if w[2] <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    density = PDF(wo, w[:3], p)
    return w[0], w[1], w[2], w[2] / density, 1.0 / density, 0.0, 0.0, 0.0


def weighted(u: Row, given: Given, p: Any) -> Row:
    """The same with the weight f cos/pdf that the sampler returns in place of cos/pdf."""
    w = SAMPLE(given[:3], (u[0], u[1], u[4]), p)
    return w[0], w[1], w[2], w[3], 0.0, 0.0, 0.0, 0.0


def undensed(u: Row, given: Given, p: Any) -> Row:
    """The same with nothing but the direction."""
    w = SAMPLE(given[:3], (u[0], u[1], u[4]), p)
    return w[0], w[1], w[2], 0.0, 0.0, 0.0, 0.0, 0.0


def probed(u: Row, given: Given, p: Any) -> Row:
    """Direction u[0] of PROBES, with the largest cos/pdf that a chart has there."""
    x, y, z = probe(given[:3], u[0])
    steepest = STEEPEST(given[:3], (x, y, z), given[3]) if z > 0.0 else 0.0
    return x, y, z, steepest, 0.0, 0.0, 0.0, 0.0


def probe(wo: Vec, k: float) -> Vec:
    """Direction k of PROBES in the plane of incidence: the mirror direction, 32 that come nearer to
    it by halves from both sides, 32 at equal angles."""
    ex, ey, so = charts.azimuth_of(wo)
    half = math.floor(0.5 * (k - 1.0))
    side = 2.0 * (k - 2.0 * half) - 3.0 if k > 0.0 else 0.0
    near = k < 33.0
    away = 0.125 * exp2(-half) if near else (half - 15.5) / 66.0  # of a turn
    c, s = turn(0.5 + side * away)
    sin, cos = (so * c + wo[2] * s, wo[2] * c - so * s) if near else (s, c)
    return -sin * ex, -sin * ey, cos


def steepest_half_vector(wo: Vec, wi: Vec, width: float) -> float:
    """The largest cos/pdf of `half_vector` at wi."""
    return wi[2] * charts.half_vector_area(wo, wi, width)


def steepest_mirror(wo: Vec, wi: Vec, width: float) -> float:
    """The largest cos/pdf of `mirror` at wi."""
    return wi[2] * charts.mirror_area(wo, wi, width)


def steepest_cosine(wo: Vec, wi: Vec, width: float) -> float:
    """The largest cos/pdf of `cosine` made periodic."""
    return STRETCH * PI


def steepest_panels(wo: Vec, wi: Vec, width: float) -> float:
    """The largest cos/pdf of `panels`, both steps at their steepest."""
    return STRETCH * STRETCH * PI


class Direction(NamedTuple):
    """A way to choose directions."""

    #: (row, given) -> row, one after another from a point to the direction; none if the way knows
    #: the model
    steps: tuple[Callable[[Row, Given], Row], ...] = ()
    #: what these leave out
    weigh: Callable[[Row, Given], Row] = weighed
    #: (u, given, p) -> row, if it does
    drawn: Callable[[Row, Given, Any], Row] | None = None
    #: whether integrands are periodic in it, as lattices need them
    periodic: bool = False
    #: (wo, wi, width) -> largest cos/pdf, where it is known
    steepest: Callable[[Vec, Vec, float], float] | None = None
    #: whether a kernel makes it for whole blocks, in a loop of its own: panels are faster in one
    blockwise: bool = True


DIRECTIONS = {
    Sampler.UNIFORM: Direction((uniform,), weighed_uniform),
    Sampler.COSINE: Direction((cosine,), weighed_cosine, steepest=steepest_cosine),
    Sampler.OWN: Direction(drawn=own),
    Sampler.HALF_VECTOR: Direction(
        (polar, half_horizon, half_vector), periodic=True, steepest=steepest_half_vector
    ),
    Sampler.MIRROR: Direction(
        (polar, mirror_horizon, mirror), periodic=True, steepest=steepest_mirror
    ),
    Sampler.PANELS: Direction(
        (panels,), periodic=True, steepest=steepest_panels, blockwise=False
    ),
    Sampler.SLOPES: Direction((slopes,), blockwise=False),
}
WEIGHTED = Direction(drawn=weighted)
UNDENSED = Direction(drawn=undensed)
