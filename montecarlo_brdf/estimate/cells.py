"""A sampler and its pdf in cells of equal probability, in compiled code.

Coordinates follow the lobe (sampling.slopes). A pdf is tabulated in nx x nb squares of them; cells
are COLUMNS of equal probability in azimuth, each cut into ROWS of equal probability along the
slope. What a call knows of them stands in `reals` from place `at` on: wo (3), smallest slope, the
edges between columns, and for each strip of azimuth the edges between rows (nb, ROWS - 1), all
counted in squares.
"""

from __future__ import annotations

import concurrent.futures
import math
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile.bind import Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.compile.layout import Buffer, Unpack, pack
from montecarlo_brdf.estimate.samplers import functions_of
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.points import independent_axis
from montecarlo_brdf.sampling.slopes import coordinates, direction

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

PARAMETERS = SAMPLE = PDF = LINE = hole()

ROWS, COLUMNS = 12, 16
FIXED = 4  # numbers before the edges
TOGETHER = 256  # numbers in each LINE


class Cut(NamedTuple):
    """The cells: size of the tables, and their numbers as `reals` holds them."""

    nx: int
    nb: int
    numbers: Array


def cell_at(x: float, b: float, reals: Reals, at: int, nb: int) -> int:
    """The cell of a place in the table: so many edges lie below it."""
    column, row = 0, 0
    for k in range(COLUMNS - 1):
        column += b >= reals[at + FIXED + k]
    below = at + FIXED + (COLUMNS - 1) + min(int(b), nb - 1) * (ROWS - 1)
    for k in range(ROWS - 1):
        row += x >= reals[below + k]
    return column * ROWS + row


def counts(ints: Ints, reals: Reals, out: Out) -> None:
    """Count draws [start, start + n) of a stream into out; its last place is for rejected ones.

    ints = (key, start, n, nx, nb, place of the cells).
    """
    p = PARAMETERS(reals)[0]
    at, stop = ints[5], ints[1] + ints[2]
    wo, scale = (reals[at], reals[at + 1], reals[at + 2]), reals[at + 3]
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
            x[j], b[j] = coordinates((wx[j], wy[j], wz[j]), wo, scale)
        for j in range(m):
            kept = wz[j] > 0.0 and abs(wx[j]) + abs(wy[j]) + wz[j] < math.inf
            at_x, at_b = x[j] * ints[3], b[j] * ints[4]
            cell = cell_at(at_x, at_b, reals, at, ints[4]) if kept else ROWS * COLUMNS
            out[cell] += 1.0
        i += m


def cells_of(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] = the cell of the j-th given direction; ints = (place of the directions, n, nx, nb,
    place of the cells)."""
    at = ints[4]
    wo, scale = (reals[at], reals[at + 1], reals[at + 2]), reals[at + 3]
    for j in range(ints[1]):
        w = ints[0] + 3 * j
        x, b = coordinates((reals[w], reals[w + 1], reals[w + 2]), wo, scale)
        out[j] = float(cell_at(x * ints[2], b * ints[3], reals, at, ints[3]))


def densities(ints: Ints, reals: Reals, out: Out) -> None:
    """The probability of each square of a table, from its middle, or from a place at random in it.

    ints = (first square, squares, nx, nb, place of wo and the smallest slope, key); out = the
    probability of each; with a key (not 0) it is followed by the directions.
    """
    p = PARAMETERS(reals)[0]
    nx, nb, at, key = ints[2], ints[3], ints[4], u64(ints[5])
    wo, scale = (reals[at], reals[at + 1], reals[at + 2]), reals[at + 3]
    wx, wy, wz, area = LINE(), LINE(), LINE(), LINE()
    done = 0
    while done < ints[1]:
        m = TOGETHER if ints[1] - done > TOGETHER else ints[1] - done
        for j in range(m):
            square = ints[0] + done + j
            i = square // nb
            x, b = 0.5, 0.5
            if ints[5] != 0:
                x = independent_axis(key, u64(square), u64(0))
                b = independent_axis(key, u64(square), u64(1))
            x, b = (i + x) / nx, (square - i * nb + b) / nb
            wx[j], wy[j], wz[j], area[j] = direction(x, b, wo, scale)
        for j in range(m):
            pdf = PDF(wo, (wx[j], wy[j], wz[j]), p)
            out[done + j] = pdf * area[j] / (nx * nb)
        if ints[5] != 0:
            for j in range(m):
                to = ints[1] + 3 * (done + j)
                out[to], out[to + 1], out[to + 2] = wx[j], wy[j], wz[j]
        done += m


def counted(
    model: Model, p: ParameterSet, cut: Cut, key: int, samples: int, threads: int = 1
) -> Array:
    """How many draws of the model's sampler lie in each cell, and last how many were rejected."""
    import numpy as np

    layout, numbers = pack([model.prepared(p)], 0)
    reals = np.concatenate([numbers, cut.numbers])
    signed = key - (1 << 64) if key >> 63 else key
    names = {"PARAMETERS": Unpack(layout), "LINE": Buffer(TOGETHER)}
    call = kernel(model.name, counts, SAMPLE=functions_of(model)["SAMPLE"], **names)

    def share(start: int, stop: int) -> Array:
        out = np.zeros(ROWS * COLUMNS + 1)
        for done, n in call.pieces(stop - start):
            call.on([signed, start + done, n, cut.nx, cut.nb, len(numbers)], reals, out)
        return out

    ends = [samples * k // threads for k in range(threads + 1)]
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        total: Array = np.sum(list(pool.map(share, ends[:-1], ends[1:])), axis=0)
    return total


def placed(model: Model, cut: Cut, w: Array) -> NDArray[np.int64]:
    """The cells of directions (n, 3) above the horizon."""
    import numpy as np

    reals, out = np.concatenate([cut.numbers, np.ravel(w)]), np.zeros(len(w))
    ints = [len(cut.numbers), len(w), cut.nx, cut.nb, 0]
    kernel(model.name, cells_of).on(ints, reals, out)
    return out.astype(np.int64)


def tabulated(
    model: Model, p: ParameterSet, place: tuple[float, ...], size: tuple[int, int], key: int = 0
) -> tuple[Array, Array]:
    """(probabilities, directions) of nx x nb squares, x first; directions only with a key. place:
    wo and the smallest slope."""
    import numpy as np

    layout, numbers = pack([model.prepared(p)], 0)
    names = {"PARAMETERS": Unpack(layout), "LINE": Buffer(TOGETHER)}
    call = kernel(model.name, densities, PDF=functions_of(model)["PDF"], **names)
    reals = np.concatenate([numbers, place])
    found, directions = [], []
    for first, n in call.pieces(size[0] * size[1]):
        out = np.zeros(n * 4 if key else n)
        call.on([first, n, *size, len(numbers), key], reals, out)
        found.append(out[:n])
        directions.append(out[n:].reshape(-1, 3))
    return np.concatenate(found), np.concatenate(directions)
