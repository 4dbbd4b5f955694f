"""Integrals over the hemisphere by a mixture of densities that no lobe escapes.

A share of the nodes is cosine-weighted, a share lies around the mirror direction, a peak of f cos
and some draws of the model's sampler, at any distance: the logarithm of the distance is uniform, so
that a lobe of any width gets its share of them. Where the model has a pdf its own draws may be a
share too. The density of a node is that of the mixture, whatever share it is from (the balance
heuristic: Veach 1997, section 9.2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.estimate.places import Rows, draws_of, values_of
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.spread import net
from montecarlo_brdf.statistics import Estimate, Moments, estimate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]
    Index = NDArray[np.integer[Any]]

#: chords between which distances from a centre are spread by their logarithm
NEAREST, FARTHEST = 1e-6, 2.0
LOGARITHM = math.log(FARTHEST / NEAREST)


TOGETHER = 1 << 16  # nodes at a time: what is kept of one is some twenty numbers
INNER = 1e-12  # numbers u keep clear of 0 and 1 by this
STARTS, ROUNDS, STEP = 48, 18, 0.25  # of the ascent to a peak of f cos, and its first step
DRAWN = 6  # own draws around which lobes may be
HEXAGON = 2.0 * np.pi * np.arange(6) / 6.0
MIRROR = np.array([-1.0, -1.0, 1.0])


class Groups(NamedTuple):
    """Parameter sets and given directions: an integral over wi for each."""

    sets: Rows
    wo: Array  # (n, 3)

    def at(self, index: Index | slice) -> Groups:
        """Some of them."""
        return Groups(self.sets.at(index), self.wo[index])


class Nodes(NamedTuple):
    """K nodes for each of n groups, the same numbers for all; every array is (n, K)."""

    w: Array  # (n, K, 3)
    f: Array
    pdf: Array  # 0 without one
    inverse: Array  # 1/density of the mixture, 0 below the horizon
    own: Flags  # whether it is the model's own draw
    weight: Array  # that this draw came with, NaN without one
    u: Array  # (K, 3)
    replicates: int

    def mean(self, x: Array) -> Array:
        """(n, replicates): integrals of x over wi."""
        return self._cut(np.where(self.inverse > 0.0, x * self.inverse, 0.0))

    def mean_of_draws(self, x: Array) -> Array:
        """(n, replicates): means of x over the model's own draws alone, 0 below the horizon."""
        drawn: Array = np.where(self.own & (self.inverse > 0.0), x, 0.0)
        return self._cut(drawn) / (self.own[0].mean() or 1.0)

    @property
    def mass(self) -> Array:
        """int pdf, and the share of draws below the horizon."""
        drawn = self.own[0].any()
        lost = 1.0 - self.mean_of_draws(np.ones_like(self.f)) if drawn else 0.0
        found: Array = self.mean(self.pdf) + lost
        return found

    def _cut(self, x: Array) -> Array:
        each: Array = x.reshape(len(x), self.replicates, -1).mean(axis=2)
        return each


def nodes_of(
    model: Model, at: Groups, centre: Array, size: int, replicates: int, key: int,
    own: bool = True, reverse: bool = False,
) -> Nodes:  # fmt: skip
    """Nodes for groups; centre: directions (n, m, 3) around which lobes may be. own: whether the
    model's draws are among them, if it has a pdf. reverse: f(w, wo) in place of f(wo, w), without
    draws."""
    drawn = own and not reverse and model.sample is not None and model.pdf is not None
    each, n = max(1, size // replicates), len(at.wo)
    shares = _shares(each, drawn)
    kinds = np.tile(np.repeat(np.arange(3), shares), replicates)
    u = np.clip(_numbers(shares, replicates, key), INNER, 1.0 - INNER)
    w, weight = np.empty((n, len(kinds), 3)), np.full((n, len(kinds)), np.nan)
    for k in range(3):
        (rows,) = np.nonzero(kinds == k)
        many, v = np.repeat(np.arange(n), len(rows)), np.tile(u[rows], (n, 1))
        if k == 0 and len(rows):
            found, weights = draws_of(model, at.wo[many], v, at.sets.at(many))
            weight[:, rows] = weights.reshape(n, -1)
        elif k == 1:
            found = cosine(v)
        elif k == 2:
            # runs of a net, not every so-maniest of its points, which share their first digits
            turn = np.tile(np.arange(shares[2]) * centre.shape[1] // shares[2], replicates * n)
            found = around(centre[many, turn], v[:, 0], v[:, 1])
        if len(rows):
            w[:, rows] = found.reshape(n, -1, 3)
    up = np.isfinite(w).all(axis=2) & (w[..., 2] > 0.0)
    w = np.where(up[..., None], w, (0.0, 0.0, 1.0))
    f, pdf = (np.where(up, x, 0.0) for x in functions_at(model, at, w, reverse))
    blind = blind_density(centre, w, (shares[1] / each, shares[2] / each))
    density = shares[0] / each * pdf + blind
    inverse = np.where(up & (density > 0.0), 1.0 / np.where(density > 0.0, density, 1.0), 0.0)
    return Nodes(w, f, pdf, inverse, np.broadcast_to(kinds == 0, up.shape), weight, u, replicates)


def functions_at(
    model: Model, at: Groups, w: Array, reverse: bool = False
) -> tuple[Array, Array]:
    """(f, pdf) at directions (n, K, 3) of each group, 0 where they are no numbers or unknown."""
    n, size = w.shape[:2]
    many, flat = np.repeat(np.arange(n), size), w.reshape(-1, 3)
    wo, sets = at.wo[many], at.sets.at(many)
    f = _values(model, wo, flat, sets, reverse).reshape(n, size)
    if reverse or model.sample is None or model.pdf is None:
        return f, np.zeros_like(f)
    return f, _finite(values_of(model, model.pdf, wo, flat, sets)).reshape(n, size)


def blind_density(centre: Array, w: Array, shares: Sequence[float] = (0.5, 0.5)) -> Array:
    """The density at w (n, K, 3) of cosine-weighted directions and those around centres, in
    shares."""
    near = np.zeros(w.shape[:2])
    for k in range(centre.shape[1]):
        near += _density_around(centre[:, k : k + 1], w)
    found: Array = shares[0] * w[..., 2] / math.pi + shares[1] * near / centre.shape[1]
    return found


def _shares(each: int, drawn: bool) -> Index:
    """How many of the nodes of a replicate are own draws, cosine-weighted, around a centre."""
    own = each // 2 if drawn else 0
    near = 2 * (each - own) // 3
    found: Index = np.array([own, each - own - near, near])
    return found


def _numbers(shares: Index, replicates: int, key: int) -> Array:
    """(K, 3): a net of each kind in each replicate, shifted at random: a net cut into kinds at
    random has several times the error."""
    rng, parts = np.random.default_rng(key), []
    for _ in range(replicates):
        parts += [np.mod(net(int(c), 7) + rng.random(3), 1.0) for c in shares if c]
    return np.concatenate(parts)


def _values(model: Model, wo: Array, w: Array, sets: Rows, reverse: bool) -> Array:
    """f, 0 where it is no number."""
    return _finite(values_of(model, model.f, *((w, wo) if reverse else (wo, w)), sets))


def _finite(x: Array) -> Array:
    found: Array = np.where(np.isfinite(x), x, 0.0)
    return found


def cosine(u: Array) -> Array:
    """(n, 3) cosine-weighted directions."""
    r, phi = np.sqrt(u[:, 0]), 2.0 * np.pi * u[:, 1]
    return np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1.0 - u[:, 0])], axis=-1)


def around(centre: Array, u0: Array, u1: Array) -> Array:
    """(n, 3) unit vectors at chords between NEAREST and FARTHEST from as many centres."""
    s = NEAREST * np.exp(LOGARITHM * u0)
    phi, along = 2.0 * np.pi * u1, s * np.sqrt(np.maximum(0.0, 1.0 - 0.25 * s * s))
    tangent, other = frame(centre)
    turned = np.cos(phi)[:, None] * tangent + np.sin(phi)[:, None] * other
    found: Array = centre * (1.0 - 0.5 * s * s)[:, None] + along[:, None] * turned
    return found


def frame(w: Array) -> tuple[Array, Array]:
    """Two unit vectors across each of (n, 3).

    Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
    """
    x, y, z = w.T
    sign = np.where(z >= 0.0, 1.0, -1.0)
    a = -1.0 / (sign + z)
    b = x * y * a
    one = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=-1)
    return one, np.stack([b, sign + y * y * a, -y], axis=-1)


def _density_around(centre: Array, w: Array) -> Array:
    """The density of `around` at w, in 1/sr: the chord s covers 2 pi s ds of the sphere."""
    away = w - centre
    square = np.maximum(np.einsum("...i,...i", away, away), NEAREST * NEAREST)
    density: Array = 1.0 / (2.0 * math.pi * LOGARITHM * square)
    return density


def centres(model: Model, at: Groups, reverse: bool = False) -> Array:
    """(n, m, 3): where lobes may be: at the mirror direction, at a peak of f cos, and where the
    model's own sampler draws."""
    found = [(at.wo * MIRROR)[:, None], peaks(model, at, reverse)[:, None]]
    if model.sample is not None and not reverse:
        n, u = len(at.wo), net(DRAWN, 11)
        many = np.repeat(np.arange(n), DRAWN)
        w = draws_of(model, at.wo[many], np.tile(u, (n, 1)), at.sets.at(many))[0]
        unit = np.abs(np.sum(w * w, axis=1) - 1.0) < 1e-6
        found.append(np.where(unit[:, None], w, at.wo[many]).reshape(n, DRAWN, 3))
    return np.concatenate(found, axis=1)


def peaks(model: Model, at: Groups, reverse: bool = False) -> Array:
    """(n, 3): a direction of large f cos for each group, uphill from the best of some everywhere.

    The mirror direction has nodes of its own: another place counts where it is nearly as high.
    """
    n, start = len(at.wo), cosine(net(STARTS, 3))
    best = np.concatenate(
        [np.repeat(start[None], n, axis=0), at.wo[:, None] * MIRROR, at.wo[:, None]], axis=1
    )
    height = _heights(model, at, best, reverse)
    height[:, -2:] *= 0.9
    top = np.argmax(height, axis=1)
    place: Array = best[np.arange(n), top]
    highest = height[np.arange(n), top]
    step = np.full(n, STEP)
    for k in range(ROUNDS):
        around_it = _hexagon(place, step, HEXAGON + k)
        height = _heights(model, at, around_it, reverse)
        top = np.argmax(height, axis=1)
        found = height[np.arange(n), top]
        up = found > highest
        place = np.where(up[:, None], around_it[np.arange(n), top], place)
        highest, step = np.where(up, found, highest), step * np.where(up, 1.2, 0.5)
    return place


def _hexagon(place: Array, step: Array, angle: Any) -> Array:
    """(n, 6, 3): unit vectors around each place."""
    one, other = frame(place)
    away: Array = np.cos(angle)[:, None] * one[:, None] + np.sin(angle)[:, None] * other[:, None]
    found = place[:, None] + step[:, None, None] * away
    unit: Array = found / np.sqrt(np.sum(found * found, axis=2))[..., None]
    return unit


def _heights(model: Model, at: Groups, w: Array, reverse: bool) -> Array:
    """(n, m): f cos at m directions of each group, below the horizon -1."""
    n, m = w.shape[:2]
    many, flat = np.repeat(np.arange(n), m), w.reshape(-1, 3)
    up = flat[:, 2] > NEAREST
    value = np.full(n * m, -1.0)
    sets = at.sets.at(many[up])
    value[up] = _values(model, at.wo[many[up]], flat[up], sets, reverse) * flat[up, 2]
    return value.reshape(n, m)


#: what is taken of nodes: (n, replicates), for several integrals (n, replicates, m)
Taken = Callable[[Nodes], "Array"]


def taken(
    model: Model, at: Groups, centre: Array, size: int, replicates: int, key: int, what: Taken,
    own: bool = True, reverse: bool = False,
) -> Array:  # fmt: skip
    """`what` of the nodes of all groups, some groups, and some replicates, at a time."""
    many, each = max(1, TOGETHER // size), max(1, size // replicates)
    runs = max(1, min(replicates, replicates * size // TOGETHER))
    how = own, reverse
    return np.concatenate([
        np.concatenate([
            what(nodes_of(model, at.at(part), centre[part], each * len(r), len(r), key + k, *how))
            for k, r in enumerate(np.array_split(np.arange(replicates), runs))
        ], axis=1)
        for part in _parts(len(at.wo), many)
    ])  # fmt: skip


def _parts(n: int, many: int) -> Iterator[slice]:
    for first in range(0, n, many):
        yield slice(first, first + many)


def estimated(means: Array, samples: int) -> Estimate:
    """An estimate of one integral from the means of its replicates.

    Nodes of a net are not independent: what single values say of the spread is nothing.
    """
    each = float(max(1, samples // len(means)))  # as `nodes_of` cuts them
    size = float(np.max(np.abs(means)))
    size = size if 0.0 < size < math.inf else 1.0  # squares of what is huge are no numbers
    return estimate([Moments(each, m, 0.0, m) for m in map(float, means / size)]).times(size)
