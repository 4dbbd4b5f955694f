"""Integrals at many places at once: which parameters and directions a law of means is asked at.

Groups of nodes (estimate.mixture) at places spread evenly, at edge angles, where the model's code
may turn another way, and where somebody asked. Their error bars only choose: what looks worst is
asked again as a claim of its own, on fresh numbers.
It cannot see: what holds less than about one in a thousand of the places and no number or branch of
the code names.
"""

from __future__ import annotations

import functools
import math
import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases import dictionary, margins
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.cases.directions import EDGES, vectors
from montecarlo_brdf.cases.points import Points, even, joined
from montecarlo_brdf.estimate.mixture import Groups, Nodes, centres, taken
from montecarlo_brdf.estimate.places import rows_of
from montecarlo_brdf.sampling.points import stream

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

PLACES = 1024  # groups of the even set
FEWEST = 64  # at any effort
NODES = 512  # of a group
REPLICATES = 8
EACH = 8  # azimuths at an edge angle
SPECIAL = 384  # groups at special parameters, and at places where the code turns
ANGLES = 256  # groups at special angles
SOME = 192  # places for what costs more
PREPARED = 96  # parameter sets of each kind, where the model prepares them
LAST = 89.9  # degrees: nearer to the horizon rounding is too much of f to integrate it
HEAVY = 1000.0  # times the mean weight: f is hardly drawn there
BLACK = 0.01  # albedo below which a surface counts as one that reflects so much


Law = Callable[[Nodes], "Array"]  # (n, replicates) of n groups of nodes


class Survey:
    """A, int pdf and what the sampler hardly draws, at the places of a case."""

    def __init__(self, case: Case) -> None:
        self.case, self.model = case, case.model
        self.points = _visible(joined(list(_places(case))))
        self.at = Groups(rows_of(case.model, case.one, self.points.table), self.points.wo)
        self.centre = centres(case.model, self.at)
        found = self.taken(slice(None), NODES, REPLICATES, _laws)
        self.reflected, self.mass, self.undrawn = (found[..., k] for k in range(3))
        #: some of the places, for what costs more
        order = case.random("some").permutation(len(self.points.wo))
        self.some = order[: case.budget(SOME, FEWEST)]

    def taken(
        self, index: Any, size: int, replicates: int, what: Law, own: bool = True
    ) -> Array:
        """What is taken of nodes for some of the places: (n, replicates, ...)."""
        at, centre = self.at.at(index), self.centre[index]
        key = stream(self.case.seed, self.model.identity, "survey", size)
        return taken(self.model, at, centre, size, replicates, key, what, own)

    def place(self, k: int) -> tuple[Case, float]:
        """The case there, and its polar angle in degrees."""
        x, y, z = map(float, self.points.wo[k])
        phi = math.degrees(math.atan2(y, x)) if x or y else 0.0
        p: Parameters = self.at.sets.parameters(k)
        there = self.case._replace(p=p, phi_o_deg=phi, viewer=(x, y, z))
        return there, math.degrees(math.atan2(math.hypot(x, y), z))

    def source(self, k: int) -> str:
        """What led to a place, if that is worth telling."""
        return self.points.labels[int(self.points.label[k])]


def reflected_of(nodes: Nodes) -> Array:
    """A."""
    return nodes.mean(nodes.f * nodes.w[..., 2])


def mass_of(nodes: Nodes) -> Array:
    """int pdf, and the share of draws below the horizon."""
    return nodes.mass


def hardly(nodes: Nodes) -> Array:
    """How much is reflected where f cos is far more than pdf accounts for."""
    value = nodes.f * nodes.w[..., 2]
    usual = np.maximum(nodes.mean(value).mean(axis=1), BLACK)[:, None]
    return nodes.mean(np.where(value > HEAVY * nodes.pdf * usual, value, 0.0))


def _laws(nodes: Nodes) -> Array:
    return np.stack([law(nodes) for law in (reflected_of, mass_of, hardly)], axis=-1)


def sure(deviation: Array) -> Array:
    """How far (n, replicates) lie from 0 at least, two standard errors being taken off."""
    error = deviation.std(axis=1, ddof=1) / math.sqrt(deviation.shape[1])
    found: Array = np.abs(deviation.mean(axis=1)) - 2.0 * error
    return np.where(np.isfinite(found), found, np.inf)


def _places(case: Case) -> Iterator[Points]:
    """Everywhere, at edge angles, where somebody asked, and where the code may turn."""
    yield even(case, case.budget(PLACES, FEWEST), "survey", prepared=PREPARED)
    edge = np.repeat(EDGES, EACH)
    turned = np.tile(np.linspace(0.0, 7.0, EACH), len(EDGES))
    start = even(case, len(edge), "edges", prepared=PREPARED)
    yield start._replace(wo=vectors(edge, turned))
    yield _asked(case)
    of_parameters = _chosen(case, dictionary.OF_PARAMETERS, SPECIAL)
    of_wo = _chosen(case, dictionary.OF_WO, ANGLES)
    if of_parameters:
        yield dictionary.points(case, max(1, min(8, SPECIAL // len(of_parameters))), of_parameters)
    yield dictionary.points(case, 1, of_wo)
    if (turns := margins.points(case)) is not None:
        rows = case.random("turns").permutation(len(turns.wo))[: case.budget(SPECIAL, FEWEST)]
        other = even(case, len(turns.wo), "turns", prepared=PREPARED)
        yield from (turns.at(rows), turns._replace(wo=other.wo).at(rows))


def _asked(case: Case) -> Points:
    """The parameter sets and angles that somebody asked about."""
    sets, angles = np.array([tuple(p) for p in case.sets]), np.radians([0.0, 45.0, 80.0])
    n, m = len(sets), len(angles)
    start = even(case, n * m, "asked")
    wo = vectors(np.tile(angles, n), math.radians(case.phi_o_deg))
    return start._replace(table=np.repeat(sets.reshape(n, -1), m, axis=0), wo=wo)


def _chosen(
    case: Case, kinds: tuple[dictionary.Place, ...], most: int
) -> list[dictionary.Special]:
    """Special values of some kinds, at random if there are too many."""
    every = [special for special in dictionary.specials(case) if special.place in kinds]
    rows = case.random("special", most).permutation(len(every))[: case.budget(most, FEWEST)]
    return [every[k] for k in sorted(rows)]


def _visible(at: Points) -> Points:
    return at.at(at.wo[:, 2] >= math.cos(math.radians(LAST)))


_lock = threading.Lock()  # checks that run side by side share what is found


@functools.lru_cache(maxsize=4)
def _survey(case: Case) -> Survey:
    return Survey(case)


def survey(case: Case) -> Survey:
    """The integrals of a case: once for all checks."""
    subject = Case(case.model, case.p, (), case.phi_o_deg, free=case.free, seed=case.seed,
                   effort=case.effort)  # fmt: skip
    with _lock:
        return _survey(subject)
