"""Draws of a sampler counted in cells, in compiled code.

Coordinates follow the lobe (sampling.slopes); cells are the leaves of a tree over them
(estimate.tree), each of a group. What a call knows of them stands in `reals` from place `at` on: wo
(3), smallest slope, the nodes of the tree, whose leaves tell their group in place of what is
compared.
"""

from __future__ import annotations

import concurrent.futures
import math
from typing import TYPE_CHECKING

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile.bind import Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.compile.layout import Buffer, Unpack, pack
from montecarlo_brdf.estimate.samplers import functions_of
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.points import independent_axis
from montecarlo_brdf.sampling.slopes import coordinates

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

PARAMETERS = SAMPLE = LINE = hole()

FIXED = 4  # numbers before the tree
NODE = 4  # numbers of a node
TOGETHER = 256  # numbers in each LINE


def group_at(x: float, b: float, reals: Reals, at: int) -> int:
    """The group of the cell at a place."""
    node = at + FIXED
    while reals[node] >= 0.0:
        along = x if reals[node] == 0.0 else b
        child = reals[node + 2] if along < reals[node + 1] else reals[node + 3]
        node = at + FIXED + NODE * int(child)
    return int(reals[node + 1])


def counts(ints: Ints, reals: Reals, out: Out) -> None:
    """Count draws [start, start + n) of a stream into out; its last place is for rejected ones.

    ints = (key, start, n, groups, place of the cells).
    """
    p = PARAMETERS(reals)[0]
    at, stop = ints[4], ints[1] + ints[2]
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
            group = group_at(x[j], b[j], reals, at) if kept else ints[3]
            out[group] += 1.0
        i += m


def groups_of(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] = the group of the j-th place; ints = (place of the places, n, place of the cells)."""
    for j in range(ints[1]):
        at = ints[0] + 2 * j
        out[j] = float(group_at(reals[at], reals[at + 1], reals, ints[2]))


def counted(
    model: Model, p: ParameterSet, numbers: Array, groups: int, key: int, samples: int,
    threads: int = 1,
) -> Array:  # fmt: skip
    """How many draws of the model's sampler lie in each group of cells, and last how many were
    rejected; numbers: of the cells, as `reals` holds them."""
    import numpy as np

    layout, first = pack([model.prepared(p)], 0)
    reals = np.concatenate([first, numbers])
    signed = key - (1 << 64) if key >> 63 else key
    names = {"PARAMETERS": Unpack(layout), "LINE": Buffer(TOGETHER)}
    call = kernel(model.name, counts, SAMPLE=functions_of(model)["SAMPLE"], **names)

    def share(start: int, stop: int) -> Array:
        out = np.zeros(groups + 1)
        for done, n in call.pieces(stop - start):
            call.on([signed, start + done, n, groups, len(first)], reals, out)
        return out

    ends = [samples * k // threads for k in range(threads + 1)]
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        total: Array = np.sum(list(pool.map(share, ends[:-1], ends[1:])), axis=0)
    return total


def placed(numbers: Array, places: Array) -> NDArray[np.int64]:
    """The groups of places (n, 2) in coordinates."""
    import numpy as np

    reals, out = np.concatenate([numbers, np.ravel(places)]), np.zeros(len(places))
    kernel("", groups_of).on([len(numbers), len(places), 0], reals, out)
    return out.astype(np.int64)
