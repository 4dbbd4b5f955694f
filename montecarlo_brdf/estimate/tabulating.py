"""A pdf tabulated over coordinates that follow its lobe, in compiled code.

The coordinates are those of estimate.quadrature, which explains them; what a call knows of them
stands in `reals` from place `at` on: wo (3), turn (2), smallest slope.
"""

from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import paced
from montecarlo_brdf.estimate.pointwise import TOGETHER, Listing
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.independent import independent_axis
from montecarlo_brdf.special import exp, expm1, log1p, turn

PARAMETERS: Any = None
PDF: Any = None
LINE: Any = None


def direction(x: float, b: float, reals: Any, at: int) -> tuple[float, float, float, float]:
    """wi and dwi/(dx db) for (x, b) in [0, 1)^2."""
    mu, scale = reals[at + 2], reals[at + 5]
    sine = reals[at] * reals[at + 3] + reals[at + 1] * reals[at + 4]
    c, s = turn(b)  # begins at -pi
    c, s = -c, -s
    k = sine / mu * c
    root = abs(k) + math.sqrt(k * k + 1.0)
    last = root if k >= 0.0 else 1.0 / root
    s2 = scale * scale
    span = log1p(last * last / s2)
    grown = s2 * exp(x * span)
    t2 = s2 * expm1(x * span)
    t = math.sqrt(t2)
    to_horizon = grown * expm1((1.0 - x) * span) / (last + t)
    z = 1.0 / math.sqrt(1.0 + t2)
    dot = z * (mu + sine * c * t)
    along, across = 2.0 * dot * z * t * c - sine, 2.0 * dot * z * t * s
    up = mu * to_horizon * (t + 1.0 / last) * (z * z)
    length = 1.0 / math.sqrt(along * along + across * across + up * up)
    along, across = along * length, across * length
    wx = reals[at + 3] * along - reals[at + 4] * across
    wy = reals[at + 4] * along + reals[at + 3] * across
    return wx, wy, up * length, 4.0 * math.pi * dot * z * z * z * grown * span


def densities(ints: Any, reals: Any, out: Any) -> None:
    """The probability of each square of a table, from its middle, or from a place at random in it.

    ints = (first square, squares, nx, nb, place of the coordinates, key); out = the probability of
    each; with a key (not 0) it is followed by the directions.
    """
    p = PARAMETERS(reals)[0]
    nx, nb, at, key = ints[2], ints[3], ints[4], ints[5]
    wo = (reals[at], reals[at + 1], reals[at + 2])
    wx, wy, wz, area = LINE(), LINE(), LINE(), LINE()
    done = 0
    while done < ints[1]:
        m = TOGETHER if ints[1] - done > TOGETHER else ints[1] - done
        for j in range(m):
            square = ints[0] + done + j
            i = square // nb
            x, b = 0.5, 0.5
            if key != 0:
                x, b = independent_axis(key, square, 0), independent_axis(key, square, 1)
            x, b = (i + x) / nx, (square - i * nb + b) / nb
            wx[j], wy[j], wz[j], area[j] = direction(x, b, reals, at)
        for j in range(m):
            pdf = PDF(wo, (wx[j], wy[j], wz[j]), p)
            out[done + j] = pdf * area[j] / (nx * nb)
        if key != 0:
            for j in range(m):
                to = ints[1] + 3 * (done + j)
                out[to], out[to + 1], out[to + 2] = wx[j], wy[j], wz[j]
        done += m


def tabulated(model: Model, p: Any, place: Any, size: tuple[int, int], key: int = 0) -> Any:
    """(probabilities, directions) of nx x nb squares, x first; directions only with a key."""
    import numpy as np

    layout, numbers = pack([model.prepared(p)], 0)
    kernel = compiled(model.name, Listing(densities, {"PDF": model.pdf}, layout))
    reals = np.concatenate([numbers, place])
    found, directions = [], []
    for first, n in paced.pieces(kernel, size[0] * size[1]):
        ints = np.array([first, n, *size, len(numbers), key], dtype=np.int64)
        out = np.zeros(n * 4 if key else n)
        if kernel(ints.ctypes.data, reals.ctypes.data, out.ctypes.data) != 0:
            raise ModelError(f"model {model.name} raised an exception while its pdf was evaluated")
        found.append(out[:n])
        directions.append(out[n:].reshape(-1, 3))
    return np.concatenate(found), np.concatenate(directions)
