"""Deterministic integrals over the hemisphere, in coordinates that follow a lobe (sampling.slopes):
nodes grow until two grids agree, and probes tell what both may have missed."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.compile.bind import Ints, Out, Reals
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.sampling.slopes import coordinates, direction

Array = NDArray[np.float64]
SMALLEST = 1e-7
#: A value so many times as large as any at the nodes around it belongs to what they have missed.
MISSED = 10.0
#: directions and the solid angle that each stands for
Probes = tuple[Array, Array]
#: numbers (n,) of directions (n, 3)
OfArray = Callable[[Array], Array]


def directions_at(ints: Ints, reals: Reals, out: Out) -> None:
    """out[4 j ...] = direction and area of the j-th (x, b); ints = (n,), reals = (wo, scale, all
    (x, b))."""
    wo, scale = (reals[0], reals[1], reals[2]), reals[3]
    for j in range(ints[0]):
        x, b = reals[4 + 2 * j], reals[5 + 2 * j]
        out[4 * j], out[4 * j + 1], out[4 * j + 2], out[4 * j + 3] = direction(x, b, wo, scale)


def coordinates_at(ints: Ints, reals: Reals, out: Out) -> None:
    """out[2 j ...] = (x, b) of the j-th direction."""
    wo, scale = (reals[0], reals[1], reals[2]), reals[3]
    for j in range(ints[0]):
        at = 4 + 3 * j
        w = (reals[at], reals[at + 1], reals[at + 2])
        out[2 * j], out[2 * j + 1] = coordinates(w, wo, scale)


class Coordinates:
    """The map between (x, b) and wi for a fixed wo; `scale` is the smallest slope of interest."""

    def __init__(self, wo: Array, scale: float) -> None:
        self.wo = np.asarray(wo, dtype=float)
        self.scale = max(float(scale), SMALLEST)

    @property
    def place(self) -> tuple[float, ...]:
        """What compiled code knows of them."""
        return (*map(float, self.wo), self.scale)

    def directions(self, x: Array, b: Array) -> tuple[Array, Array]:
        """(wi, dw/dx db) for coordinates in (0, 1): wi has shape (n, 3)."""
        out = self._map(directions_at, np.stack([x, b], axis=-1), 4)
        return out[:, :3], out[:, 3]

    def coordinates(self, wi: Array) -> tuple[Array, Array]:
        """(x, b) of directions (n, 3) above the horizon."""
        out = self._map(coordinates_at, np.asarray(wi), 2)
        return np.clip(out[:, 0], 0.0, 1.0), np.mod(out[:, 1], 1.0)

    def _map(self, template: Callable[[Any, Any, Any], None], rows: Array, width: int) -> Array:
        out = np.empty((len(rows), width))
        reals = np.concatenate([self.place, rows.ravel()])
        kernel("", template).on([len(rows)], reals, out)
        return out


class Integral(NamedTuple):
    """A deterministic integral with an error estimate, and what of that lies where probes alone saw
    it."""

    value: float
    error: float
    missed: float = 0.0


def scale_of(wo: Array, wi: Array) -> float:
    """A slope below which few of the drawn directions lie."""
    h = np.asarray(wi) + np.asarray(wo)
    slopes = np.hypot(h[:, 0], h[:, 1]) / np.maximum(h[:, 2], 1e-300)
    if not len(slopes):
        return 1.0
    wide, sharp = np.quantile(slopes, (0.1, 1e-3))
    return float(min(0.3 * wide, 3.0 * sharp))  # differ where a sharp lobe is drawn now and then


@functools.lru_cache(maxsize=8)
def grid(nx: int, nb: int) -> tuple[Array, Array, Array]:
    """Gauss-Legendre in x, midpoints in b: nodes and weights, flattened."""
    node, weight = np.polynomial.legendre.leggauss(nx)
    b = (np.arange(nb) + 0.5) / nb
    x, bb = np.meshgrid(0.5 * (node + 1.0), b, indexing="ij")
    w = np.repeat(0.5 * weight / nb, nb)
    return x.ravel(), bb.ravel(), w


SIZES = ((24, 16), (48, 32), (96, 64), (128, 256), (192, 768))


def integrate(
    function: OfArray,
    coordinates: Coordinates,
    target: float = 1e-6,
    probes: tuple[Probes, ...] = (),
) -> Integral:
    """Integral of function(wi) over the hemisphere; nodes grow until two sizes agree.

    The error is the difference between the last two sizes: of the coarser one, so it errs on the
    safe side for an integrand that is resolved at all. Where two sizes agree because both miss a
    lobe, `probes` may see it: what they say that it holds is then the error.
    """
    last, error = np.nan, np.inf
    for nx, nb in SIZES:
        x, b, w = grid(nx, nb)
        wi, jacobian = coordinates.directions(x, b)
        values = function(wi)
        value = float(np.sum(w * jacobian * values))
        error = abs(value - last)
        if error <= target * abs(value):
            break
        last = value
    error = error if np.isfinite(error) else abs(value)
    highest = _highest_around(np.abs(values).reshape(nx, nb))
    place = coordinates, x.reshape(nx, nb)[:, 0], highest
    missed = max((_missed(function, probe, *place) for probe in probes), default=0.0)
    return Integral(value, max(error, missed) + 1e-14 * abs(value), missed)


def _highest_around(values: Array) -> Array:
    """Of every node and its eight neighbours the highest; b goes around."""
    b = np.maximum(values, np.maximum(np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)))
    padded = np.pad(b, ((1, 1), (0, 0)), mode="edge")
    highest: Array = np.maximum(b, np.maximum(padded[:-2], padded[2:]))
    return highest


def _missed(
    function: OfArray, probe: Probes, coordinates: Coordinates, nodes: Array, highest: Array
) -> float:
    """The integral of what is far above the values at the nodes around it."""
    wi, angle = probe
    if not len(wi):
        return 0.0
    values = np.abs(function(wi))
    x, b = coordinates.coordinates(wi)
    i = np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), x)
    j = np.minimum((b * highest.shape[1]).astype(int), highest.shape[1] - 1)
    return float(np.sum((values * angle)[values > MISSED * highest[i, j]]))
