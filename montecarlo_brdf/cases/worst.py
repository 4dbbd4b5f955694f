"""The worst place of a quantity: over angles, azimuths where they matter, and free parameters.

Thousands of places spread over all of them together, each with few nodes; the best again with more
nodes; every coordinate scanned finely along its own line through the best, so that a bump of 1 % of
a range is met once the others are where it shows; then steps that climb from some of the best, and
many nodes to tell which of them is the worst. All places use the same nodes: differences between
them are not noise.
It cannot see: a bump that holds less than about one in ten thousand of the places.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.cases.directions import MIRROR, vectors
from montecarlo_brdf.estimate.places import Rows, mean_values, seeing, values_of
from montecarlo_brdf.estimate.quadrature import grid
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import samplers_of
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.sampling.spread import net, spread
from montecarlo_brdf.vectors import Vec, from_degrees

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

ANGLES = (0.0, 30.0, 50.0, 65.0, 76.0, 84.0, 88.0, 89.9)
LAST = 89.9  # nearer to the horizon a textbook GGX in rounded arithmetic is too noisy to search
SHARP = 2.0  # times as much as elsewhere makes a lobe
#: places of the scan by the number of coordinates, and sets of parameters that are prepared
PLACES = (512, 4096, 16384)
PREPARED = 48


class Stage(StrEnum):
    """How closely a place is looked at."""

    SCAN = "scan"
    ASCENT = "ascent"
    POLISH = "polish"


#: nodes of a mean: draws of the model's own sampler, or (slopes, azimuths) where it has none
NODES = {
    Stage.SCAN: (64, (16, 8)),
    Stage.ASCENT: (1024, (32, 24)),
    Stage.POLISH: (1 << 16, (128, 128)),
}
FEWEST = 64  # nodes at any effort
CANDIDATES = 2048  # places of the scan among which the best are chosen
KEPT = 64  # places of the scan that are looked at again
APART = 0.15  # between two of them, in one of the coordinates
STARTS = 4  # of them, places from which steps are made
LINE = 128  # places along each line
SWEEPS = 2
STEPS = 0.12, 1e-4, 48  # first, last, and how many at most
BEYOND = 0.04  # of a range, so that its very ends are met

#: a place as numbers in [0, 1]: angle, azimuth if it matters, parameters
At = Sequence[float]
#: values at places (n, coordinates), with the nodes of a stage
Value = Callable[["Array", Stage], "Array"]


class Spot(NamedTuple):
    """A place as numbers in [0, 1] (angle, azimuth if it matters, parameters), and its value."""

    at: tuple[float, ...]
    value: float


class Space(NamedTuple):
    """Where a case may be looked at."""

    case: Case

    @property
    def turning(self) -> int:
        """1 if the azimuth matters, else 0."""
        return int(not self.case.model.isotropic)

    @property
    def size(self) -> int:
        """The number of coordinates."""
        return 1 + self.turning + len(self.case.free)

    def direction(self, at: At) -> tuple[float, float]:
        """Polar angle and azimuth in degrees."""
        return LAST * at[0], 360.0 * at[1] if self.turning else self.case.phi_o_deg

    def vector(self, at: At) -> Vec:
        """The direction itself."""
        return from_degrees(*self.direction(at))

    def vectors(self, at: Array) -> Array:
        """The directions (n, 3) of many places."""
        phi = 360.0 * at[:, 1] if self.turning else self.case.phi_o_deg
        return vectors(np.radians(LAST * at[:, 0]), np.radians(phi))

    def parameters(self, at: At) -> Parameters:
        """The parameter set."""
        free = at[1 + self.turning :]
        return parameters.at(self.case, dict(zip(self.case.free, free, strict=True)))

    def rows(self, at: Array) -> Rows:
        """The parameter sets of many places."""
        return parameters.rows(self.case, at[:, 1 + self.turning :])

    def own(self) -> tuple[float, ...]:
        """The case's own parameters as coordinates."""
        return tuple(parameters.position(self.case, self.case.one).values())

    def where(self, at: At, letter: str) -> dict[str, float]:
        """The place as findings give it."""
        theta, phi = self.direction(at)
        turned = {f"phi_{letter}_deg": round(phi, 3)} if phi else {}
        changed = parameters.changed(self.case, self.parameters(at))
        return {f"theta_{letter}_deg": round(theta, 3), **turned, **changed}


def albedo(space: Space, of: Quantity) -> Value:
    """A or R by the sampler that sees the lobe, or in slopes of half vectors where there is none;
    infinite where it is not a number."""
    model = space.case.model

    def value(at: Array, stage: Stage) -> Array:
        w = space.vectors(at)
        sets = space.rows(at)
        own = Sampler.OWN in samplers_of(model, of)
        side = np.ones(len(w)) if own else _side(space, w, sets)
        places = np.concatenate([w, side[:, None]], axis=1)
        nodes, by = _nodes(space, of, stage), seeing(model, of)
        found = mean_values(model, of, by, nodes, places, sets)
        return np.where(np.isfinite(found), found, math.inf)

    return value


def _side(space: Space, w: Array, sets: Rows) -> Array:
    """Where f has a lobe for w: 1 at its mirror direction, -1 at w itself, 0 at neither."""

    def f(other: Array) -> Array:
        return values_of(space.case.model, space.case.model.f, w, other, sets)

    retro, mirror = f(w), f(w * MIRROR)
    beside = np.maximum(*(f(np.tile(vectors(0.9, phi), (len(w), 1))) for phi in (1.0, 4.0)))
    side = np.where(retro > SHARP * mirror, -1.0, 1.0)
    return np.where(np.maximum(retro, mirror) > SHARP * beside, side, 0.0)


def _nodes(space: Space, of: Quantity, stage: Stage) -> Array:
    draws, cells = NODES[stage]
    draws = space.case.budget(draws, FEWEST)
    if Sampler.OWN in samplers_of(space.case.model, of):
        u = net(draws, stream(space.case.seed, "search"))
        return np.concatenate([u, np.full((draws, 1), 1.0 / draws)], axis=1)
    x, b, weight = grid(*cells)
    return np.stack([x, b, np.zeros(len(x)), weight], axis=1)


def worst(space: Space, value: Value) -> Spot:
    """Where `value` is largest, as far as scan, lines and steps can tell."""
    scanned = _scan(space)
    kept = _best(scanned, value(scanned, Stage.SCAN), space.case.budget(KEPT, STARTS))
    starts = _best(kept, value(kept, Stage.ASCENT), STARTS)
    starts = np.concatenate([starts, [_lines(space, value, starts[0])]])
    tops = _ascend(value, starts)
    values = value(tops, Stage.POLISH)
    k = int(np.argmax(values))
    return Spot(tuple(map(float, tops[k])), float(values[k]))


def _best(places: Array, values: Array, count: int) -> Array:
    """The highest places, each at some distance from those before: a plateau is one of them."""
    chosen = []
    if len(places) > CANDIDATES:
        high = np.sort(np.argpartition(-values, CANDIDATES)[:CANDIDATES])
        places, values = places[high], values[high]
    values = values.copy()
    for _ in range(min(count, len(places))):
        chosen.append(int(np.argmax(values)))
        values[np.abs(places - places[chosen[-1]]).max(axis=1) < APART] = -math.inf
    return places[chosen]


def _scan(space: Space) -> Array:
    """The case's own parameters at some angles, then places everywhere."""
    own = [(t / LAST, *(0.0,) * space.turning, *space.own()) for t in ANGLES]
    n = space.case.budget(PLACES[min(space.size, len(PLACES)) - 1])
    at = spread(n, space.size, stream(space.case.seed, "places"))
    at = np.clip((1.0 + 2.0 * BEYOND) * at - BEYOND, 0.0, 1.0)
    if space.case.model.prepare:
        first = 1 + space.turning
        at[:, first:] = at[np.arange(n) % PREPARED, first:]
    return np.concatenate([np.array(own), at])


def _lines(space: Space, value: Value, at: Array) -> Array:
    """Every coordinate in turn scanned from end to end, the others staying at the best so far."""
    steps = np.linspace(0.0, 1.0, LINE)
    for axis in [*range(space.size)] * SWEEPS:
        places = np.tile(at, (LINE + 1, 1))
        places[1:, axis] = steps
        at = places[int(np.argmax(value(places, Stage.ASCENT)))]
    return at


def _ascend(value: Value, starts: Array) -> Array:
    """Steps from every start to its best neighbour, halved where none of them gets higher."""
    step, last, most = STEPS
    size = starts.shape[1]
    offsets = np.concatenate([np.zeros((1, size)), np.eye(size), -np.eye(size)])
    offsets[:, 0] /= 3.0  # along the angle lobes change fast
    for _ in range(most):
        around = np.clip(starts[:, None, :] + step * offsets[None, :, :], 0.0, 1.0)
        values = value(around.reshape(-1, size), Stage.ASCENT).reshape(len(starts), -1)
        chosen = np.argmax(values, axis=1)
        starts = around[np.arange(len(starts)), chosen]
        step *= 1.0 if chosen.any() else 0.5
        if step < last:
            break
    return starts
