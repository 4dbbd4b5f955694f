"""Charts of regions of directions: the hemisphere by slopes of half vectors, or what lies within an
angle of an axis above the horizon."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.compile.bind import Ints, Out, Reals
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.sampling.slopes import coordinates, direction
from montecarlo_brdf.vectors import Vec

Array = NDArray[np.float64]
SMALLEST = 1e-7
FINEST = 1e-5  # slope from which on half vectors are told apart where no other is given
QUARTERS = np.linspace(0.0, 1.0, 5)


class Chart(Protocol):
    """The square (0, 1)^2 as a region of directions, which ends where x = 1."""

    edges: tuple[Array, Array]  # of the first cells, in x and in y
    movable: bool  # whether these may lie elsewhere
    nodes: tuple[int, int]  # along a side of a cell, of a fine and of a coarse rule

    def directions(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Directions (n, 3), and solid angle per dx dy."""

    def coordinates(self, wi: Array) -> tuple[Array, Array]:
        """(x, y) of directions, within [0, 1] only for those of the region."""


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
    """The hemisphere by half vectors with a fixed wo; `scale` is the smallest slope of interest."""

    edges, movable, nodes = (QUARTERS, QUARTERS), True, (8, 6)

    def __init__(self, wo: Sequence[float] | Array, scale: float = FINEST) -> None:
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


class Around:
    """What lies within the angle `reach` of an axis and above the horizon: x is the angle, y the
    azimuth about the axis within the horizon, 1/2 towards the normal."""

    movable, nodes = True, (8, 6)

    def __init__(self, axis: Vec, reach: float) -> None:
        self._tilt = math.atan2(math.hypot(axis[0], axis[1]), axis[2])
        self._axis = np.array(axis)
        self._low = max(0.0, self._tilt - 0.5 * math.pi)
        self._high = max(self._low, min(reach, 0.5 * math.pi + self._tilt, math.pi))
        self._side = _towards_normal(self._axis)
        self._across = np.cross(self._axis, self._side)
        self.edges = self._bends(), QUARTERS

    def _bends(self) -> Array:
        """Where circles about the axis begin to meet the horizon, and end to."""
        bends = abs(0.5 * math.pi - self._tilt), 1.5 * math.pi - self._tilt
        inner = {(b - self._low) / ((self._high - self._low) or 1.0) for b in bends}
        return np.array([0.0, *sorted(x for x in inner if 1e-9 < x < 1.0 - 1e-9), 1.0])

    def directions(self, x: Array, y: Array) -> tuple[Array, Array]:
        """(wi, dw/dx dy)."""
        angle = self._low + x * (self._high - self._low)
        half = self._half_turn(angle)
        turn, s = (2.0 * y - 1.0) * half, np.sin(angle)
        side = (s * np.cos(turn))[:, None] * self._side + (s * np.sin(turn))[:, None] * self._across
        wi = np.cos(angle)[:, None] * self._axis + side
        wi[:, 2] = np.maximum(wi[:, 2], 1e-300)  # but for rounding they lie above the horizon
        return wi, 2.0 * (self._high - self._low) * s * half

    def coordinates(self, wi: Array) -> tuple[Array, Array]:
        """(x, y) of directions."""
        along, across = wi @ self._side, wi @ self._across
        angle = np.arctan2(np.hypot(along, across), wi @ self._axis)
        y = 0.5 + 0.5 * np.arctan2(across, along) / np.maximum(self._half_turn(angle), 1e-300)
        return (angle - self._low) / ((self._high - self._low) or 1.0), y

    def _half_turn(self, angle: Array) -> Array:
        """Azimuths up to this from the one towards the normal are above the horizon."""
        with np.errstate(divide="ignore", invalid="ignore"):
            c = -np.cos(angle) * math.cos(self._tilt) / (np.sin(angle) * math.sin(self._tilt))
        c = np.where(np.isnan(c), -1.0, c)
        return np.arccos(np.clip(c, -1.0, 1.0))


def _towards_normal(axis: Array) -> Array:
    """Of the unit vectors across an axis the one nearest to the normal."""
    up = np.array([0.0, 0.0, 1.0]) - axis[2] * axis
    length = float(np.linalg.norm(up))
    return up / length if length > 1e-12 else np.array([1.0, 0.0, 0.0])


class Texels(Around):
    """The hemisphere in the rows and columns of an image: the normal in the top row, azimuth 0 in
    the middle column."""

    movable, nodes = False, (4, 3)

    def __init__(self, height: int, width: int) -> None:
        super().__init__((0.0, 0.0, 1.0), 0.5 * math.pi)
        rows = np.arange((height + 1) // 2 + 1) * (2.0 / height)
        self.edges = np.minimum(rows, 1.0), np.arange(width + 1) / width
