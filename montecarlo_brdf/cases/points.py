"""The points that all laws are asked at: parameters, both directions and three numbers u.

They are spread evenly over everything at once, at edges of directions and of ranges, and where the
model's own code may turn another way (cases.dictionary, cases.margins). Every law is asked at all
of them: what one of them meets, all have met.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.directions import HIGHEST_COSINE, MIRROR, edge_pairs
from montecarlo_brdf.estimate.mixture import around
from montecarlo_brdf.estimate.places import draws_of, rows_of
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.sampling.spread import spread

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index

EVEN = 1 << 16  # points of the even set
FEWEST = 1 << 10  # at any effort
PREPARED = 96  # parameter sets of it where the model prepares them
BEYOND = 0.04  # of a range, so that its very ends are met
INNER = 1e-9  # numbers u keep clear of 0 and 1 by this
ENDS = (0.0, 5e-324, 2.0**-53, 0.5, 1.0 - 2.0**-53)  # of numbers u
ULPS = 2.0**-53 * np.arange(-2.0, 3.0)


class Points(NamedTuple):
    """Parameter sets, directions and numbers, one of each per row, and what led there."""

    table: Array  # (n, parameters)
    wo: Array  # (n, 3)
    wi: Array
    u: Array
    label: Any  # (n,) places in `labels`
    labels: tuple[str, ...] = ("",)

    def at(self, index: Any) -> Points:
        """Some of them."""
        table, wo, wi, u, label, labels = self
        return Points(table[index], wo[index], wi[index], u[index], label[index], labels)

    def labelled(self, label: Index, labels: Sequence[str]) -> Points:
        """The same points, found otherwise."""
        return self._replace(label=label, labels=tuple(labels))


def joined(parts: Sequence[Points]) -> Points:
    """All points of several sets."""
    first = np.cumsum([0, *(len(part.labels) for part in parts)])
    labels = np.concatenate([part.label + k for part, k in zip(parts, first, strict=False)])
    table, wo, wi, u = (np.concatenate([part[k] for part in parts]) for k in range(4))
    return Points(table, wo, wi, u, labels, tuple(text for part in parts for text in part.labels))


def even(case: Case, n: int, *name: object, prepared: int = PREPARED) -> Points:
    """One set spread evenly over parameters, both directions and numbers; a quarter at the very
    parameters asked about. wi is anywhere, or where lobes are: drawn by the model's own sampler,
    around the mirror direction or wo at any distance, and exactly there or an ulp or two beside."""
    free = len(case.free)
    x = spread(n, 7 + free, stream(case.seed, case.model.identity, "points", *name))
    t = np.clip((1.0 + 2.0 * BEYOND) * x[:, 7:] - BEYOND, 0.0, 1.0)
    if case.model.prepare:
        t = t[np.arange(n) % prepared]
    table = parameters.table(case, t)
    own = np.arange(n) % 4 == 1
    table[own] = np.array([tuple(p) for p in case.sets])[np.arange(own.sum()) % len(case.sets)]
    wo, wi = (direction(cosines(x[:, k]), 2.0 * np.pi * x[:, k + 1]) for k in (0, 2))
    u = np.clip(x[:, 4:7], INNER, 1.0 - INNER)
    found = Points(table, wo, wi, u, np.zeros(n, dtype=np.intp))
    return _towards_lobes(case, found, x[:, 2], x[:, 3])


def _towards_lobes(case: Case, at: Points, s: Array, t: Array) -> Points:
    """Half of the points with wi where lobes may be, by two numbers of each."""
    kind, wi = np.arange(len(at.wo)) * 7 % 16, at.wi.copy()
    near = (kind >= 5) & (kind < 9)
    centre = at.wo * np.where(t[:, None] < 0.75, MIRROR, 1.0)
    wi[near] = around(centre[near], s[near], np.mod(4.0 * t[near], 1.0))
    exact = kind == 9
    ulps = ULPS[(1e6 * at.u[exact]).astype(int) % 5] * (np.mod(8.0 * t[exact, None], 1.0) < 0.5)
    wi[exact] = centre[exact] + ulps
    own = (kind < 5) if case.model.sample else np.zeros(len(kind), dtype=bool)
    if own.any():
        sets = rows_of(case.model, case.one, at.table[own])
        wi[own] = draws_of(case.model, at.wo[own], at.u[own], sets)[0]
    above = np.isfinite(wi).all(axis=1) & (wi[:, 2] > HIGHEST_COSINE)
    return at._replace(wi=np.where(above[:, None], wi, at.wi))


def cosines(t: Array) -> Array:
    """Cosines for even numbers: a third of them even in the cosine, a third in the angle, a third
    in its logarithm and in that of the angle at the normal."""
    part, x = np.divmod(3.0 * t, 1.0)
    log = np.where(
        x < 0.7, HIGHEST_COSINE ** (x / 0.7), 1.0 - HIGHEST_COSINE ** ((x - 0.7) / 0.3)
    )
    found: Array = np.where(part == 0.0, x, np.where(part == 1.0, np.cos(0.5 * np.pi * x), log))
    return found


def direction(cosine: Array, phi: Array) -> Array:
    """(n, 3) directions above the horizon."""
    z = np.clip(cosine, HIGHEST_COSINE, 1.0)
    s = np.sqrt((1.0 - z) * (1.0 + z))
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1)


def edges(case: Case) -> Points:
    """Edge angles against each other (directions.edge_pairs), for the parameters asked about, some
    inside, and each at the ends of its range; with numbers u at their ends."""
    sets = [*parameters.sets(case, 2), *parameters.extremes(case)]
    sets = sets[: case.budget(len(sets), 2)]
    wo, wi = edge_pairs()
    n, m = len(sets), len(wo)
    table = np.repeat(np.array([tuple(p) for p in sets]).reshape(n, -1), m, axis=0)
    ends = np.array([(a, b, 0.5) for a in ENDS for b in ENDS])
    u, label = ends[np.arange(n * m) % len(ends)], np.zeros(n * m, dtype=np.intp)
    return Points(table, np.tile(wo, (n, 1)), np.tile(wi, (n, 1)), u, label)
