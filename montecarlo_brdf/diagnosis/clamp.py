"""A bound on parameters that pdf has and sample has not: draws are made again with it."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis.ask import asked, drawn
from montecarlo_brdf.diagnosis.laws import DENSITY

if TYPE_CHECKING:
    from montecarlo_brdf.cases.case import Parameters
    from montecarlo_brdf.diagnosis.geometry import Array
    from montecarlo_brdf.diagnosis.of_pdf import Known

STEP = 1e-6  # of u
SOME = 20  # draws of a place
CLOSE = 0.25  # mean |log| from which a bound is refined
REFINED = 10


def clamp_told(known: Known) -> str | None:
    """'pdf clamps ax and ay below 0.15, sample does not: ... pdf is wider'."""
    if not known.bad or any(d.of is None or len(d.of.shares) > 1 for d in known.draws):
        return None
    names = known.at.names
    bad = [i for i, k in enumerate(known.index) if k in known.bad]
    for keys in [(k,) for k in names] + list(itertools.combinations(names, 2)):
        for below in (True, False):
            t = _bound(known, keys, below, bad)
            if t is not None:
                words = "below" if below else "above"
                return (
                    f"pdf clamps {' and '.join(keys)} {words} {t:.4g}, sample does not: with the "
                    f"clamp in sample too pdf is right at all {len(known.index)} cases; pdf is "
                    f"{'wider' if below else 'narrower'}"
                )
    return None


def _bound(known: Known, keys: tuple[str, ...], below: bool, bad: list[int]) -> float | None:
    def extreme(i: int) -> float:
        values = [float(getattr(known.sets[i], k)) for k in keys]
        return min(values) if below else max(values)

    chosen = (max if below else min)(bad, key=extreme)
    start = extreme(chosen)
    if not start > 0.0:
        return None
    grid = start * np.exp(np.linspace(0.02, 1.5, 16) * (1.0 if below else -1.0))
    e = _off(known, chosen, keys, below, grid)
    if not np.nanmin(e) < CLOSE:
        return None
    for _ in range(REFINED):
        k = int(np.nanargmin(e))
        low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
        grid = np.linspace(low, high, 9)
        e = _off(known, chosen, keys, below, grid)
    t = float(grid[int(np.nanargmin(e))])
    every = [_off(known, i, keys, below, np.array([t]))[0] for i in range(len(known.index))]
    return t if max(every) < 2.0 * DENSITY else None


def _off(
    known: Known, i: int, keys: tuple[str, ...], below: bool, bounds: Array
) -> Array:
    """How far pdf is from the density of draws with each bound: mean |log pdf J|."""
    m, d, p = known.at.model, known.draws[i], known.sets[i]
    assert m.pdf is not None
    pick = max if below else min
    sets = [p._replace(**{k: pick(float(getattr(p, k)), float(t)) for k in keys}) for t in bounds]
    u, wo = d.u[:SOME], d.g.wo[0]
    steps = [np.zeros(3), *(s * STEP * np.eye(3)[a] for a in (0, 1) for s in (1.0, -1.0))]
    rows: list[tuple[Parameters, Array, Array]] = [(q, wo, u + h) for q in sets for h in steps]
    w = [x for x, _ in drawn(m, rows)]
    pdf = asked(m, m.pdf, [(p, wo, w[5 * k]) for k in range(len(sets))])
    found = []
    for k, v in enumerate(pdf):
        w0, a, b, c, e = w[5 * k : 5 * k + 5]
        area = np.linalg.norm(np.cross(a - b, c - e), axis=1) / (2.0 * STEP) ** 2
        ok = np.isfinite(v * area) & (w0[:, 2] > 1e-3)
        with np.errstate(all="ignore"):
            logs = np.abs(np.log(np.maximum((v * area)[ok], 1e-300)))
        found.append(float(np.mean(np.minimum(1.0, logs))) if len(logs) > 8 else math.inf)
    return np.array(found)
