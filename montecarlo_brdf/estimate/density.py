"""The density of a sampler's draws at a direction, by all the numbers that give it.

For a drawn direction w, in every piece of u[2] (where a sampler may choose lobes), all pairs (u, v)
are found that give it, by Newton's method on `sample` itself. The density of the draws is

    density(w) = sum over pieces k, share_k p_k(w),  p_k(w) = sum over roots 1/|dw/du x dw/dv|,

by the change of variables: one law for maps that are folded, mixtures, lobes chosen by u[0], and
rejection. A root that is missed makes it smaller, never larger; so it is a lower bound, and what
lies below it by more than rounding is refuted whatever was missed.
It cannot see: draws at single directions (atoms), which have no density, and samplers whose
lobes' shares depend on the other numbers or in which all three numbers place a direction: `unknown`
says so.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.estimate.pieces import Draw, Piece, pieces
from montecarlo_brdf.estimate.places import draws_of, rows_of
from montecarlo_brdf.estimate.roots import Draws, Roots, Search, own_roots
from montecarlo_brdf.estimate.tangents import STEP, tangents
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Counts = NDArray[np.intp]

#: keeps draws away from the poles of u, where differences are less exact
MARGIN = 2.0**-10
FINER = 8.0  # times: the second step width
POOL = 2048  # draws that searches start from, at least


class Density(NamedTuple):
    """Draws of a sampler for one direction and parameter set, and their density, in 1/sr.

        d = density(model, p, wo, inner(numpy.random.default_rng(0), 40))
        ratio = pointwise(model, p).pdf(wo, d.w) / d.density  # 1 where pdf is right

    Rows without a density (draws that are not above the horizon, atoms, draws at fault) are NaN,
    all of them where `unknown` says why. Else density = lobes @ shares. Where a piece has no root
    (`roots` is 0) it may have none, or one that was missed: the density then is a lower bound, so
    that a pdf above it means nothing there; a pdf below it is always wrong. Of an honest sampler 99
    of 100 rows are right to 1e-5, next to the ends of u, and most to 1e-9; where folds or seams of
    the map are nearer than a difference's step `error` says so. E[weight | w] is `mean_weight`.
    """

    u: Array  # (n, 3)
    w: Array  # (n, 3), as drawn
    weight: Array  # (n,) as returned, NaN if the sampler returns none
    density: Array  # (n,)
    error: Array  # (n,): by how much two step widths of differences disagree, 1/sr
    lobes: Array  # (n, pieces): p_k(w), each a density of its own
    roots: Counts  # (n, pieces): how many were found
    light: Array  # (n,): sum over roots of share weight/|dw/du x dw/dv|
    own: Array  # (n,): what the draw's own numbers add to the density
    pieces: tuple[Piece, ...]
    rejected: float  # share of the draws that are not above the horizon
    unknown: str | None = None  # why the density is not known

    @property
    def shares(self) -> Array:
        """(pieces,): how often each is drawn."""
        return np.array([piece.share for piece in self.pieces])

    @property
    def mean_weight(self) -> Array:
        """(n,): E[weight | w], the mean over the roots: f cos/density if the weight is right, also
        where each draw's own is only so on average, as of one lobe of several."""
        with np.errstate(all="ignore"):
            return self.light / self.density


def inner(rng: np.random.Generator, n: int) -> Array:
    """Numbers u (n, 3) that keep clear of 0 and 1."""
    return rng.random((n, 3)) * (1.0 - 2.0 * MARGIN) + MARGIN


def density(
    model: Model,
    p: ParameterSet,
    wo: Vec,
    u: Array,
    seed: int = 0,
    step: float = STEP,
    others: bool = True,
) -> Density:
    """The density of the draws at those of the numbers u (n, 3), as `inner` makes them, for a
    direction wo and one parameter set; 40 of them are enough where only laws are looked at, as
    searches start from others besides. `step`: of u in differences. Without `others` a draw's own
    numbers count alone, which is cheap: a lower bound where a direction belongs to several."""
    more = inner(np.random.default_rng(seed), max(0, POOL - len(u)) if others else 0)
    pool = Draws(drawing(model, p, wo), np.concatenate([u, more]), len(u))
    found = pieces_of(model, p, wo)
    return _unknown(pool, found) if isinstance(found, str) else _summed(pool, found, step, others)


@functools.lru_cache(maxsize=64)
def pieces_of(model: Model, p: ParameterSet, wo: Vec) -> list[Piece] | str:
    """The pieces of u[2], or why there are none."""
    return pieces(drawing(model, p, wo), np.random.default_rng(0))


def _unknown(pool: Draws, why: str) -> Density:
    """Draws without their density."""
    n = pool.asked
    none, empty = np.full(n, np.nan), np.zeros((n, 0))
    return Density(pool.u[:n], pool.w[:n, :3], pool.w[:n, 3], none, none, empty,
                   empty.astype(np.intp), none, none, (), pool.rejected, why)  # fmt: skip


def drawing(model: Model, p: ParameterSet, wo: Vec) -> Draw:
    """The sampler for one direction and parameter set, compiled, on arrays."""
    model = model.of(p)
    sets, fixed = rows_of(model, p, np.array([tuple(p)], dtype=float)), np.array(wo)

    def draw(u: Array) -> Array:
        w, weight = draws_of(model, fixed, u, sets)
        return np.column_stack([w, weight])

    return draw


def _summed(pool: Draws, found: list[Piece], step: float, others: bool) -> Density:
    """Over pieces and roots."""
    parts = [
        _part(pool, piece, Search(pool, piece).roots if others else own_roots(pool, piece), step)
        for piece in found
    ]
    lobes, error, light, own = (
        np.stack([getattr(part, name) for part in parts], axis=1) for name in Part._fields[:4]
    )
    shares = np.array([piece.share for piece in found])
    total, own = lobes @ shares, own @ shares
    total[~(own > 0.0)] = np.nan
    n, roots = pool.asked, np.stack([part.roots for part in parts], axis=1)
    return Density(pool.u[:n], pool.w[:n, :3], pool.w[:n, 3], total, error @ shares, lobes, roots,
                   light @ shares, own, tuple(found), pool.rejected)  # fmt: skip


class Part(NamedTuple):
    """What the roots in one piece add up to, see `Density`, without its share."""

    lobe: Array
    error: Array
    light: Array
    own: Array
    roots: Counts


def _part(pool: Draws, piece: Piece, found: Roots, step: float) -> Part:
    """Of one piece. Of two differences the one that makes the density smaller counts: neighbours
    across a fold of the map are too near each other. An area of 0 is an atom's, or rounding."""
    (u, row), n = found, pool.asked
    areas = np.stack([tangents(pool.draw, u, piece, h).area for h in (step, step / FINER)])
    with np.errstate(all="ignore"):
        each = piece.extent / piece.share / areas
    each[~np.isfinite(each)] = 0.0
    least, own = each.min(axis=0), np.zeros(n)
    first = np.concatenate([[True], np.diff(row) > 0])[: len(row)] & pool.within(piece)[row]
    own[row[first]] = least[first]
    sums = (least, np.abs(each[1] - each[0]), least * pool.draw(u)[:, 3])
    lobe, error, light = (np.bincount(row, x, n).astype(float) for x in sums)
    return Part(lobe, error, light, own, np.bincount(row, minlength=n))
