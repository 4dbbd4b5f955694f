"""Counting directions in cells of equal probability, in compiled code: drawn or given ones.

Cells are cut by a density tabulated in nx x nb squares over coordinates that follow a lobe
(checks._cells): COLUMNS of equal probability in azimuth, each cut into ROWS of equal probability
along the slope. What a call knows of them stands in `reals` from place `at` on: wo (3), turn (2),
smallest slope, the edges between columns, and for each strip of azimuth the edges between rows
(nb, ROWS - 1), all counted in squares.
"""

from __future__ import annotations

import concurrent.futures
import math
from typing import Any, NamedTuple

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import paced
from montecarlo_brdf.estimate.pointwise import TOGETHER, Listing
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.independent import independent_axis
from montecarlo_brdf.special import log1p, polar_angle

PARAMETERS: Any = None
SAMPLE: Any = None
LINE: Any = None

ROWS, COLUMNS = 12, 16
FIXED = 6  # numbers before the edges
TWO_PI = 2.0 * math.pi


class Cut(NamedTuple):
    """The cells: size of the tables, and their numbers as `reals` holds them."""

    nx: int
    nb: int
    numbers: Any


def coordinates(w: Any, reals: Any, at: int, nx: int, nb: int) -> tuple[float, float]:
    """Where a direction above the horizon lies in the table: (slope, azimuth) in its squares.

    Without a call or a branch, so that a loop over many directions becomes vector instructions.
    """
    hx, hy, hz = w[0] + reals[at], w[1] + reals[at + 1], w[2] + reals[at + 2]
    along = hx * reals[at + 3] + hy * reals[at + 4]
    across = hy * reals[at + 3] - hx * reals[at + 4]
    slope = math.sqrt(along * along + across * across)
    inverse = 1.0 / max(slope, 1e-300)
    c, s = abs(along) * inverse, abs(across) * inverse
    c = c if slope > 0.0 else 1.0  # the centre counts as azimuth 0
    turned = polar_angle(s, c) / TWO_PI
    turned = 0.5 - turned if along < 0.0 else turned
    turned = 1.0 - turned if across < 0.0 else turned
    sine = reals[at] * reals[at + 3] + reals[at + 1] * reals[at + 4]
    k = sine / reals[at + 2] * (-c if along < 0.0 else c)
    root = abs(k) + math.sqrt(k * k + 1.0)
    horizon = (root if k >= 0.0 else 1.0 / root) / reals[at + 5]
    steep = slope / (hz * reals[at + 5])
    return log1p(steep * steep) / log1p(horizon * horizon) * nx, turned * nb


def cell_at(x: float, b: float, reals: Any, at: int, nb: int) -> int:
    """The cell of a place in the table: so many edges lie below it."""
    column, row = 0, 0
    for k in range(COLUMNS - 1):
        column += b >= reals[at + FIXED + k]
    below = at + FIXED + (COLUMNS - 1) + min(int(b), nb - 1) * (ROWS - 1)
    for k in range(ROWS - 1):
        row += x >= reals[below + k]
    return column * ROWS + row


def counts(ints: Any, reals: Any, out: Any) -> None:
    """Count draws [start, start + n) of a stream into out; its last place is for rejected ones.

    ints = (key, start, n, nx, nb, place of the cells).
    """
    p = PARAMETERS(reals)[0]
    at, stop = ints[5], ints[1] + ints[2]
    wo = (reals[at], reals[at + 1], reals[at + 2])
    key = u64(ints[0])
    wx, wy, wz, x, b = LINE(), LINE(), LINE(), LINE(), LINE()
    i = ints[1]
    while i < stop:
        m = TOGETHER if stop - i > TOGETHER else stop - i
        for j in range(m):
            u = (
                independent_axis(key, u64(i + j), u64(0)),
                independent_axis(key, u64(i + j), u64(1)),
                independent_axis(key, u64(i + j), u64(2)),
            )
            wx[j], wy[j], wz[j] = SAMPLE(wo, u, p)[:3]
        for j in range(m):
            x[j], b[j] = coordinates((wx[j], wy[j], wz[j]), reals, at, ints[3], ints[4])
        for j in range(m):
            kept = wz[j] > 0.0 and abs(wx[j]) + abs(wy[j]) + wz[j] < math.inf
            cell = cell_at(x[j], b[j], reals, at, ints[4]) if kept else ROWS * COLUMNS
            out[cell] += 1.0
        i += m


def places(ints: Any, reals: Any, out: Any) -> None:
    """out[j] = the cell of the j-th given direction; ints = (place of the directions, n, nx, nb,
    place of the cells)."""
    for j in range(ints[1]):
        at = ints[0] + 3 * j
        w = (reals[at], reals[at + 1], reals[at + 2])
        x, b = coordinates(w, reals, ints[4], ints[2], ints[3])
        out[j] = float(cell_at(x, b, reals, ints[4], ints[3]))


def drawn(model: Model, p: Any, cut: Cut, key: int, samples: int, threads: int = 1) -> Any:
    """How many draws of the model's sampler lie in each cell, and last how many were rejected."""
    import numpy as np

    layout, numbers = pack([model.prepared(p)], 0)
    reals = np.concatenate([numbers, cut.numbers])
    signed = key - (1 << 64) if key >> 63 else key
    kernel = compiled(model.name, Listing(counts, {"SAMPLE": model.sample}, layout))

    def share(start: int, stop: int) -> Any:
        out = np.zeros(ROWS * COLUMNS + 1)
        for done, n in paced.pieces(kernel, stop - start):
            ints = np.array([signed, start + done, n, cut.nx, cut.nb, len(numbers)], dtype=np.int64)
            if kernel(ints.ctypes.data, reals.ctypes.data, out.ctypes.data) != 0:
                raise ModelError(f"model {model.name} raised an exception while it was sampled")
        return out

    ends = [samples * k // threads for k in range(threads + 1)]
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        return sum(pool.map(share, ends[:-1], ends[1:]))


def placed(model: Model, p: Any, cut: Cut, w: Any) -> Any:
    """The cells of directions (n, 3) above the horizon."""
    import numpy as np

    layout, _ = pack([model.prepared(p)], 0)
    kernel = compiled(model.name, Listing(places, {}, layout))
    reals = np.concatenate([cut.numbers, np.ravel(w)])
    out = np.zeros(len(w))
    ints = np.array([len(cut.numbers), len(w), cut.nx, cut.nb, 0], dtype=np.int64)
    kernel(ints.ctypes.data, reals.ctypes.data, out.ctypes.data)
    return out.astype(int)
