"""STAND-IN: density of the draws by the roots of the sampler."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.diagnosis.ask import drawn

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array
    from montecarlo_brdf.model import Model

STEP = 1e-6
POOL, GRID, BISECTIONS, NEWTONS, MOST_PIECES = 400, 26, 30, 8, 8
INNER = 3e-6


@dataclass
class Density:
    """Of n draws at one place, see the fields."""

    density: Array  # (n,) nan where unknown
    lobes: Array  # (n, pieces) density within each piece
    shares: Array  # (pieces,)
    missing: Any  # (n,) a piece without a root: density is a lower bound
    several: Any  # (n,) whether own piece has several roots
    own: Array  # (n,) 1/J of the draw itself
    roots: list[list[list[float]]]  # [draw][piece] -> J of each root
    weight: Array  # (n,) mean weight over the roots


def pieces(model: Model, places: list[Any]) -> list[tuple[Array, Array] | None]:
    """(middles, shares) of the pieces of u[2] of each place, or None."""
    rng = np.random.default_rng(5)
    uu = rng.random((2, 2)) * 0.8 + 0.1
    grid = np.linspace(1e-9, 1 - 1e-9, GRID)
    n = len(places)
    rows = []
    for s in places:
        for a, b in uu:
            rows.append((s, np.column_stack([np.full(GRID, a), np.full(GRID, b), grid])))
    got = [w for w, _ in drawn(model, [(s.p, s.wo, u) for s, u in rows])]
    jumps = []  # (row, lo, hi)
    for r, w in enumerate(got):
        change = ~np.isclose(w[:-1], w[1:], rtol=0, atol=1e-9, equal_nan=True).all(axis=1)
        where = np.flatnonzero(change)
        if len(where) <= MOST_PIECES:
            jumps += [[r, grid[i], grid[i + 1], w[i]] for i in where]
        else:
            jumps.append([r, None, None, None])
    real = [j for j in jumps if j[1] is not None]
    for _ in range(BISECTIONS if real else 0):
        asks = []
        for j in real:
            s, u = rows[j[0]]
            asks.append((s.p, s.wo, np.array([[u[0, 0], u[0, 1], 0.5 * (j[1] + j[2])]])))
        for j, (w, _) in zip(real, drawn(model, asks)):
            same = np.allclose(w[0], j[3], rtol=0, atol=1e-9, equal_nan=True)
            mid = 0.5 * (j[1] + j[2])
            if same:
                j[1] = mid
            else:
                j[2] = mid
    found: list[Any] = []
    for k in range(n):
        two = [[j for j in jumps if j[0] == r] for r in (2 * k, 2 * k + 1)]
        if any(j[1] is None for t in two for j in t) or len(two[0]) != len(two[1]):
            found.append(None)
            continue
        a, b = (np.array([j[2] for j in t]) for t in two)
        if len(a) and np.max(np.abs(a - b)) > 1e-6:
            found.append(None)
            continue
        edges = np.array([0.0, *a, 1.0])
        found.append((0.5 * (edges[1:] + edges[:-1]), np.diff(edges)))
    return found


def _apart(a: Array, b: Array) -> Array:
    d = np.abs(a - b)
    d[..., 1] = np.minimum(d[..., 1], 1 - d[..., 1])
    return np.hypot(d[..., 0], d[..., 1])


def densities(model: Model, places: list[Any], us: list[Array], ws: list[Array]) -> list[Density | None]:
    """Density of the draws ws of numbers us at each place."""
    cut = pieces(model, places)
    rng = np.random.default_rng(99)
    pool2 = rng.random((POOL, 2)) * (1 - 2e-3) + 1e-3
    asks, keys = [], []
    for k, c in enumerate(cut):
        for j in range(len(c[0]) if c else 0):
            asks.append((places[k].p, places[k].wo, np.column_stack([pool2, np.full(POOL, c[0][j])])))
            keys.append((k, j))
    pools = dict(zip(keys, [w for w, _ in drawn(model, asks)]))
    # starts
    starts = []  # place, piece, draw, u0,u1, mid, target, near, own
    for (k, j), pw in pools.items():
        middles, shares = cut[k]
        lo = shares[:j].sum()
        u, w = us[k], ws[k]
        mine = (u[:, 2] >= lo) & (u[:, 2] < lo + shares[j])
        gap = np.linalg.norm(pw[None] - w[:, None], axis=2)
        gap[~np.isfinite(gap)] = 9.0
        order = np.argsort(gap, axis=1)[:, :4]
        for i in range(len(w)):
            if mine[i]:
                starts.append((k, j, i, u[i, 0], u[i, 1], 0.0, True))
            for q in order[i][: 4 if mine[i] else 2]:
                starts.append((k, j, i, pool2[q, 0], pool2[q, 1], gap[i, q], False))
    if not starts:
        return [None] * len(places)
    K = np.array([s[0] for s in starts]); J = np.array([s[1] for s in starts]); I = np.array([s[2] for s in starts])
    U = np.array([[s[3], s[4], cut[s[0]][0][s[1]]] for s in starts])
    near = np.array([s[5] for s in starts]); own = np.array([s[6] for s in starts])
    target = np.concatenate([ws[k][i][None] for k, i in zip(K, I)])
    order = np.argsort(K, kind="stable")
    K, J, I, U, near, own, target = (x[order] for x in (K, J, I, U, near, own, target))
    bounds = np.searchsorted(K, np.arange(len(places) + 1))

    def ask(u: Array, index: Any) -> tuple[Array, Array]:
        asks = []
        kk = K[index]
        b = np.searchsorted(kk, np.arange(len(places) + 1))
        for k in range(len(places)):
            if b[k + 1] > b[k]:
                asks.append((places[k].p, places[k].wo, u[b[k]:b[k + 1]]))
        got = drawn(model, asks)
        return np.concatenate([w for w, _ in got]), np.concatenate([t for _, t in got])

    state = np.zeros(len(K), int)  # 0 running, 1 found, 2 lost
    jac = np.full(len(K), np.nan)
    weight = np.full(len(K), np.nan)
    for _ in range(NEWTONS):
        run = np.flatnonzero(state == 0)
        if not len(run):
            break
        u = U[run]
        x, t = ask(u, run)
        sides = []
        for axis in (0, 1):
            h = np.zeros(3); h[axis] = STEP
            sides.append((ask(u + h, run)[0] - ask(u - h, run)[0]) / (2 * STEP))
        area = np.linalg.norm(np.cross(sides[0], sides[1]), axis=1)
        miss = target[run] - x
        A = np.stack(sides, axis=2)
        ok = np.isfinite(miss).all(1) & np.isfinite(A).all((1, 2))
        hit = ok & (np.linalg.norm(miss, axis=1) < 1e-8)
        state[run[~ok]] = 2
        state[run[hit]] = 1
        jac[run[hit]], weight[run[hit]] = area[hit], t[hit]
        go = ok & ~hit
        M = np.einsum("nij,nik->njk", A[go], A[go])
        M[:, [0, 1], [0, 1]] *= 1 + 1e-14
        det = M[:, 0, 0] * M[:, 1, 1] - M[:, 0, 1] ** 2
        rhs = np.einsum("nij,ni->nj", A[go], miss[go])
        with np.errstate(all="ignore"):
            du = np.stack([M[:, 1, 1] * rhs[:, 0] - M[:, 0, 1] * rhs[:, 1], M[:, 0, 0] * rhs[:, 1] - M[:, 0, 1] * rhs[:, 0]], 1) / det[:, None]
        bad = ~np.isfinite(du).all(1)
        du = np.clip(np.where(bad[:, None], 0, du), -0.25, 0.25)
        new = U[run[go]]
        new[:, 0] = np.clip(new[:, 0] + du[:, 0], INNER, 1 - INNER)
        new[:, 1] = np.clip(np.mod(new[:, 1] + du[:, 1], 1.0), INNER, 1 - INNER)
        U[run[go]] = new
        state[run[go][bad]] = 2
    out: list[Density | None] = []
    for k in range(len(places)):
        if cut[k] is None:
            out.append(None)
            continue
        middles, shares = cut[k]
        n, m = len(ws[k]), len(middles)
        lobes = np.zeros((n, m)); missing = np.zeros(n, bool); doubt = np.zeros(n, bool)
        several = np.zeros(n, bool); ownd = np.full(n, np.nan); mean = np.zeros(n)
        roots: list[list[list[float]]] = [[[] for _ in range(m)] for _ in range(n)]
        block = slice(bounds[k], bounds[k + 1])
        for j in range(m):
            sel = np.flatnonzero(J[block] == j) + bounds[k]
            by: dict[int, list[int]] = {}
            for r in sel:
                by.setdefault(int(I[r]), []).append(int(r))
            for i in range(n):
                rows = by.get(i, [])
                kept: list[int] = []
                for r in sorted(rows, key=lambda r: (not own[r], near[r])):
                    if state[r] == 1 and all(_apart(U[r, :2], U[q, :2]) > 1e-4 for q in kept):
                        kept.append(r)
                mine = any(own[r] for r in rows)
                if mine and kept and own[kept[0]]:
                    ownd[i] = 1 / jac[kept[0]] if jac[kept[0]] > 0 else np.inf
                if mine and len(kept) > 1:
                    several[i] = True
                if not kept:
                    missing[i] = True
                    if rows and not mine and min(near[r] for r in rows) < 0.15:
                        doubt[i] = True
                for r in kept:
                    roots[i][j].append(float(jac[r]))
                    if jac[r] > 0:
                        lobes[i, j] += 1 / jac[r]
                        mean[i] += shares[j] / jac[r] * weight[r]
        dens = lobes @ shares
        dens[doubt] = np.nan
        with np.errstate(all="ignore"):
            out.append(Density(dens, lobes, shares, missing, several, ownd, roots, mean / dens))
    return out
