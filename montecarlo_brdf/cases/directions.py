"""Pairs of directions where BRDFs go wrong, and what rounding explains there."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]
    Pairs = tuple[Array, Array]  # wo and wi, (n, 3) each

    #: f or pdf of (n, 3) wo and wi
    At = Callable[[Array, Array], Array]
    Index = NDArray[np.integer[Any]]
    #: the same with the parameters of the rows of an index
    OfRows = Callable[[Index, Array, Array], Array]

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


def rounding(f: At, wo: Array, wi: Array, rng: np.random.Generator) -> Array:
    """How much f changes when the directions move by an ulp or some: where that is as much as what
    was found, nothing was found."""
    before, noise = f(wo, wi), np.zeros(len(wo))
    for _ in range(NEIGHBOURS):
        after = f(_moved(wo, rng), _moved(wi, rng))
        noise = np.fmax(noise, np.where(np.isfinite(after), np.abs(after - before), 0.0))
    return noise


def _moved(w: Array, rng: np.random.Generator) -> Array:
    """By up to 4 ulps of each coordinate; near the horizon, where z = 1 - x x - y y has lost
    digits, by up to 256. What is exactly 0, or the normal, stays so: code may ask for it."""
    lost = (rng.random((len(w), 1)) < 0.5) & (w[:, 2:] < 1e-3)
    ulps = rng.integers(-2, 3, w.shape) + rng.integers(-2, 3, w.shape)
    ulps[w[:, 2] == 1.0] = 0
    moved: Array = w + 2.0**-52 * np.where(lost, 64.0, 1.0) * w * ulps
    return moved


def around(f: At, wo: Array, wi: Array) -> Array:
    """The largest |f| between the polar angles of each pair, at any azimuth."""
    found, sine = np.zeros(len(wo)), np.hypot(wi[:, 0], wi[:, 1])
    start = np.arctan2(wo[:, 1], wo[:, 0])
    for k in range(TURNS if len(wo) else 0):
        phi = start + 2.0 * np.pi * k / TURNS
        values = np.abs(f(wo, np.stack([sine * np.cos(phi), sine * np.sin(phi), wi[:, 2]], -1)))
        found = np.fmax(found, np.where(np.isfinite(values), values, 0.0))
    return found


def unexplained(
    relative: Array, difference: Array, tolerance: float, f: OfRows, places: Sequence[Pairs],
    rng: np.random.Generator,
) -> Array:  # fmt: skip
    """`relative`, with 0 where rounding of the directions explains the difference (near grazing a
    dot product such as wo . h may have no digit left), or where f itself is but a rest of rounding;
    places: the pairs of directions between which f differs.
    """
    (suspect,) = np.nonzero(relative > tolerance)
    suspect = suspect[np.argsort(-relative[suspect], kind="stable")]
    rest = relative.copy()
    for start in range(0, len(suspect), SUSPECTS):  # the worst first: one that stands is enough
        some = suspect[start : start + SUSPECTS]
        of_some, there = functools.partial(f, some), [(wo[some], wi[some]) for wo, wi in places]
        noise = np.maximum.reduce([rounding(of_some, *pair, rng) for pair in there])
        excused = difference[some] <= np.fmax(2.0 * noise, ROUNDING * around(of_some, *there[0]))
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
