"""The axes of a table: where its cells lie, and in which cells a place between them lies."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from enum import StrEnum
from typing import NamedTuple

from montecarlo_brdf.errors import UserError

MOST_AXES = 3
MOST_CELLS = 4_000_000
GRAZING = 1e-9  # the least mu: no viewer looks along the surface
Point = tuple[float, ...]  # a number per axis


class Angle(StrEnum):
    """Axes that are no parameters: of the viewer."""

    MU = "mu"  # cos(theta_o)
    THETA = "theta"  # degrees
    PHI = "phi"  # degrees


class Placement(StrEnum):
    """Where the values of an axis lie."""

    CENTRES = "centres"  # of equal intervals, as texels do
    EDGES = "edges"  # from end to end


class Axis(NamedTuple):
    """Equal steps from `low` to `high`."""

    name: str
    low: float
    high: float
    size: int
    placement: Placement = Placement.CENTRES

    @property
    def first(self) -> float:
        """The first value."""
        return self.low + self._offset * self.step

    @property
    def last(self) -> float:
        """The last value."""
        return self.high - self._offset * self.step

    @property
    def step(self) -> float:
        """From one value to the next."""
        edges = self.placement is Placement.EDGES
        return (self.high - self.low) / (self.size - 1 if edges else self.size)

    @property
    def _offset(self) -> float:
        return 0.0 if self.placement is Placement.EDGES else 0.5

    def values(self) -> list[float]:
        """All values."""
        if self.placement is Placement.CENTRES:
            return [self.low + (k + 0.5) / self.size * (self.high - self.low)
                    for k in range(self.size)]  # fmt: skip
        last = self.size - 1
        return [self.low + k / last * (self.high - self.low) for k in range(self.size)]

    def told(self) -> str:
        """'mu = (i + 0.5)/64': how an index becomes a value."""
        span, last = self.high - self.low, self.size - 1
        centres = self.placement is Placement.CENTRES
        part = f"(i + 0.5)/{self.size}" if centres else f"i/{last}"
        scaled = part if span == 1.0 else f"{span:.9g} {part}"
        return f"{self.name} = {scaled if self.low == 0.0 else f'{self.low:.9g} + {scaled}'}"


def checked(axes: Sequence[Axis]) -> tuple[Axis, ...]:
    """The axes of a table. Raises UserError for what is none."""
    if not 1 <= len(axes) <= MOST_AXES:
        raise UserError(f"a table has 1 to {MOST_AXES} axes, not {len(axes)}")
    names = [axis.name for axis in axes]
    for axis in axes:
        _check(axis)
        if names.count(axis.name) > 1:
            raise UserError(f"axis {axis.name} is given twice")
    if {Angle.MU, Angle.THETA} <= {*names}:
        raise UserError("mu and theta are the same angle: one of them can be an axis")
    cells = math.prod(axis.size for axis in axes)
    if cells > MOST_CELLS:
        raise UserError(f"a table of {cells:.3g} cells is more than the {MOST_CELLS} allowed")
    return tuple(axes)


def _check(axis: Axis) -> None:
    name, low, high = axis.name, axis.low, axis.high
    if axis.size < 2:
        raise UserError(
            f"axis {name} needs 2 values or more, not {axis.size}: a single value is no axis but "
            f"a parameter, as -p {name}={low:g}, or an angle, as --theta-o"
        )
    if not low < high:
        raise UserError(f"axis {name} must run from low to high, not from {low:g} to {high:g}")
    first, last = axis.first, axis.last
    ends = f"its values go from {first:.6g} to {last:.6g}"
    if name == Angle.MU and not (first > 0.0 and last <= 1.0):
        raise UserError(
            f"axis mu, the cosine of the viewer's angle, must lie in (0, 1]; {ends}: take centres, "
            "or begin at 0.001"
        )
    if name == Angle.THETA and not (first >= 0.0 and last < 90.0):
        raise UserError(f"axis theta must lie in [0, 90) degrees; {ends}")


def points(axes: Sequence[Axis]) -> Iterator[Point]:
    """The places of all cells, the last axis fastest."""
    return itertools.product(*(axis.values() for axis in axes))


def said(axes: Sequence[Axis], point: Sequence[float]) -> dict[str, float]:
    """A place by names."""
    return {axis.name: float(x) for axis, x in zip(axes, point, strict=True)}
