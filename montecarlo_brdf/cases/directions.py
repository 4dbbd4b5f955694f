"""Pairs of directions where BRDFs go wrong: edges first, then everywhere, then along the lobe."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.estimate.places import Rows

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]
    Pairs = tuple[Array, Array]  # wo and wi, (n, 3) each

    #: f or pdf of (n, 3) wo and wi
    Function = Callable[[Array, Array], Array]
    #: how far from right each of n pairs with parameters of its own is
    Deviation = Callable[[Array, Array, Rows], Array]

LAST = math.nextafter(0.5 * math.pi, 0.0)  # 90 degrees less an ulp: cos = 2.8e-16
#: polar angles in radians: normal, next to it, ordinary, grazing, the last double before 90 degrees
EDGES = (
    0.0,
    1e-8,
    1e-3,
    *(math.radians(d) for d in (20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.999)),
    0.5 * math.pi - 1e-7,
    LAST,
)
AZIMUTHS = (0.0, 1e-7, 0.5, 0.5 * math.pi, 2.5, math.pi - 1e-7, math.pi, 4.0)
RANDOM = 20_000
LOBE = 20_000
SPECIAL = 2_000
SCATTERED = 100_000  # pairs with parameters of their own
PREPARED = 32  # different ones where the model prepares them
MIRROR = np.array([-1.0, -1.0, 1.0])
NEIGHBOURS = 64
TURNS = 16  # azimuths of wi, the mirror direction's among them
ROUNDING = 1e-12  # of |f| between the same polar angles: what is smaller is rounding
SUSPECTS = 256  # pairs at a time that rounding may explain
HIGHEST_COSINE = 1e-6  # ordinary random directions keep clear of the horizon by this


def vectors(theta: ArrayLike, phi: ArrayLike) -> Array:
    """(n, 3) unit vectors; near 90 degrees the cosine keeps its relative accuracy."""
    theta, phi = np.broadcast_arrays(np.asarray(theta, dtype=float), np.asarray(phi, dtype=float))
    s = np.sin(theta)
    return np.stack([s * np.cos(phi), s * np.sin(phi), np.cos(theta)], axis=-1).reshape(-1, 3)


def edge_pairs() -> Pairs:
    """Every edge angle against every other at every azimuth; wi = wo, wi = mirror, wi . wo = 0;
    and every one where x is exactly 0, which no azimuth makes it."""
    to, ti, phi = (g.ravel() for g in np.meshgrid(EDGES, EDGES, AZIMUTHS, indexing="ij"))
    wo, wi = vectors(to, 0.0), vectors(ti, phi)
    each = vectors(np.array(EDGES), 0.3)
    mirror = each * MIRROR
    across = vectors(0.5 * np.pi - np.array(EDGES), 0.3 + np.pi)
    tilted = each[across[:, 2] > 0.0], across[across[:, 2] > 0.0]
    ahead = vectors(np.array(EDGES), 0.0)
    aside = ahead[:, [1, 0, 2]]
    return (
        np.concatenate([wo, each, each, tilted[0], ahead, aside, aside]),
        np.concatenate([wi, each, mirror, tilted[1], aside, ahead[::-1], aside[::-1]]),
    )


def random_pairs(rng: np.random.Generator, n: int) -> Pairs:
    """Uniform directions, half of them with cosines spread evenly over their logarithm."""

    def some() -> Array:
        u = rng.random((n, 3))
        cosine = np.where(u[:, 2] < 0.5, u[:, 0], HIGHEST_COSINE ** u[:, 0])
        cosine = np.maximum(cosine, HIGHEST_COSINE)
        s = np.sqrt((1.0 - cosine) * (1.0 + cosine))
        phi = 2.0 * np.pi * u[:, 1]
        return np.stack([s * np.cos(phi), s * np.sin(phi), cosine], axis=-1)

    return some(), some()


def special_pairs(rng: np.random.Generator, n: int) -> Pairs:
    """wi = wo and wi = mirror of wo at random directions, exactly and an ulp or two beside."""
    wo, _ = random_pairs(rng, n)
    partners = [wo, wo * MIRROR]
    partners += [w + 2.0**-53 * rng.integers(-2, 3, size=w.shape) for w in partners]
    return np.concatenate([wo] * len(partners)), np.concatenate(partners)


def lobe_pairs(case: Case, p: Parameters, rng: np.random.Generator, n: int) -> Pairs:
    """Random wo with wi drawn by the model's own sampler: pairs that see a lobe of any width."""
    if case.model.sample is None:
        wo, _ = random_pairs(rng, n)
        centre = np.where(rng.random((n, 1)) < 0.5, wo, wo * MIRROR)  # lobes sit at either
        wi = centre + 0.1 * rng.normal(size=(n, 3)) * rng.random((n, 1)) ** 4
        wi /= np.sqrt(np.sum(wi * wi, axis=1))[:, None]
    else:
        wo, _ = random_pairs(rng, n)
        wi, _ = pointwise(case.model, p).sample(wo, rng.random((n, 3)))
    above = wi[:, 2] > HIGHEST_COSINE
    return wo[above], wi[above]


def all_pairs(case: Case, p: Parameters, rng: np.random.Generator, *more: Pairs) -> Pairs:
    """Edges, random pairs, special pairs, pairs along the lobe, and `more`."""
    kinds = [
        edge_pairs(),
        random_pairs(rng, case.budget(RANDOM)),
        special_pairs(rng, case.budget(SPECIAL)),
        lobe_pairs(case, p, rng, case.budget(LOBE)),
        *more,
    ]
    return np.concatenate([k[0] for k in kinds]), np.concatenate([k[1] for k in kinds])


def worst_pair(
    case: Case, rng: np.random.Generator, deviation: Deviation, few: bool = False
) -> tuple[Parameters, Pairs]:
    """(parameters, pair) of the worst of many random pairs, each with free parameters of its own,
    now and then at the ends of their ranges: what goes wrong in a corner of directions and
    parameters together. deviation(wo, wi, parameter sets); few: they are costly to prepare."""
    n = case.budget(SCATTERED)
    wo, wi = random_pairs(rng, n)
    t = np.clip(1.1 * rng.random((n, len(case.free))) - 0.05, 0.0, 1.0)
    if few or case.model.prepare:
        t = t[np.arange(n) % PREPARED]
    sets = parameters.rows(case, t)
    k = int(np.argmax(deviation(wo, wi, sets)))
    return sets.parameters(k), (wo[k : k + 1], wi[k : k + 1])


def subjects(
    case: Case, rng: np.random.Generator, deviation: Deviation, few: bool = False
) -> list[tuple[Parameters, *tuple[Pairs, ...]]]:
    """Parameter sets that a law of f is asked for: the case's own, some inside, those at the ends
    of the ranges; then those of the worst of many pairs, with that pair."""
    sets = (*parameters.sets(case), *parameters.extremes(case))
    found: list[tuple[Parameters, *tuple[Pairs, ...]]] = [(p,) for p in sets]
    return [*found, worst_pair(case, rng, deviation, few)] if case.free else found


def rounding(f: Function, wo: Array, wi: Array, rng: np.random.Generator) -> Array:
    """How much f changes when the directions move by an ulp or two: where that is as much as what
    was found, nothing was found."""
    before, noise = f(wo, wi), np.zeros(len(wo))
    for _ in range(NEIGHBOURS):
        moved = (w + 2.0**-52 * (w * _ulps(rng, w) + _ulps(rng, w)) for w in (wo, wi))
        noise = np.fmax(noise, np.abs(f(*moved) - before))
    return noise


def _ulps(rng: np.random.Generator, w: Array) -> Array:
    return rng.integers(-2, 3, w.shape).astype(float)


def around(f: Function, wo: Array, wi: Array) -> Array:
    """The largest |f| between the polar angles of each pair, at any azimuth."""
    found, sine = np.zeros(len(wo)), np.hypot(wi[:, 0], wi[:, 1])
    start = np.arctan2(wo[:, 1], wo[:, 0])
    for k in range(TURNS if len(wo) else 0):
        phi = start + 2.0 * np.pi * k / TURNS
        values = np.abs(f(wo, np.stack([sine * np.cos(phi), sine * np.sin(phi), wi[:, 2]], -1)))
        found = np.fmax(found, np.where(np.isfinite(values), values, 0.0))
    return found


def unexplained(
    relative: Array,
    difference: Array,
    tolerance: float,
    f: Function,
    wo: Array,
    wi: Array,
    rng: np.random.Generator,
) -> Array:
    """`relative`, with 0 where rounding of the directions explains the difference (near grazing a
    dot product such as wo . h may have no digit left), or where f itself is but a rest of rounding.
    """
    (suspect,) = np.nonzero(relative > tolerance)
    suspect = suspect[np.argsort(-relative[suspect], kind="stable")]
    rest = relative.copy()
    for start in range(0, len(suspect), SUSPECTS):  # the worst first: one that stands is enough
        some = suspect[start : start + SUSPECTS]
        there = wo[some], wi[some]
        excused = difference[some] <= 2.0 * rounding(f, *there, rng)
        excused |= difference[some] <= ROUNDING * around(f, *there)
        rest[some[excused]] = 0.0
        if not excused.all():
            break
    return rest


def place(wo: Array, wi: Array) -> dict[str, float]:
    """A pair as angles in degrees, as findings give it."""

    def angles(w: Array) -> tuple[float, float]:
        theta = math.degrees(math.atan2(math.hypot(w[0], w[1]), w[2]))
        return round(theta, 9), round(math.degrees(math.atan2(w[1], w[0])), 9)

    (to, po), (ti, pi) = angles(wo), angles(wi)
    return {"theta_o_deg": to, "phi_o_deg": po, "theta_i_deg": ti, "phi_i_deg": pi}
