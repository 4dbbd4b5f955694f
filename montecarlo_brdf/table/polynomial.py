"""Polynomials in place of a table: least squares over its cells, or through Chebyshev's nodes.

Both are found in Chebyshev's polynomials and told in powers of x = 2 (axis - low)/(high - low) - 1
and so on: powers of the axes' own numbers would cancel. Coefficients are singles and so is all
arithmetic that is measured, as in a shader.
"""

from __future__ import annotations

import itertools
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev as cheb
from numpy.typing import NDArray

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.table.axes import GRAZING, Angle, Axis, Point
from montecarlo_brdf.table.cell import Terms
from montecarlo_brdf.table.cells import Cells, at
from montecarlo_brdf.table.subject import Subject

Array = NDArray[np.float64]
MOST_DEGREE = 16
LETTERS = "xyz"


class Way(StrEnum):
    """How coefficients are found."""

    LEAST_SQUARES = "polynomial"
    CHEBYSHEV = "chebyshev"


class Fit(NamedTuple):
    """Coefficients (measures, degree + 1 along each axis) of powers of x, y, z."""

    way: Way
    degree: int
    coefficients: NDArray[np.float32]
    axes: tuple[Axis, ...]

    def at(self, points: Array) -> Array:
        """Values (measures, n) at (n, axes), in single precision."""
        found = np.repeat(self.coefficients[..., None], len(points), axis=-1)
        for axis, column in zip(self.axes, points.T, strict=True):  # Horner, axis after axis
            scale, shift = _scaling(axis)
            x, total = scale * column.astype(np.float32) + shift, found[:, -1]
            for k in range(self.degree - 1, -1, -1):
                total = total * x + found[:, k]
            found = total
        return found.astype(np.float64)

    def text(self, measure: int, suffix: str = "") -> str:
        """As an expression in x, y, z of Python and of shading languages; C's floats have a
        suffix."""
        return _nested(self.coefficients[measure], LETTERS[: len(self.axes)], suffix)

    def letters(self, suffix: str = "") -> dict[str, str]:
        """What x, y and z are."""
        found = {}
        for letter, axis in zip(LETTERS, self.axes, strict=False):
            scale, shift = (_number(float(v)) for v in _scaling(axis))
            found[letter] = f"{scale}{suffix}*{axis.name} + {shift}{suffix}".replace("+ -", "- ")
        return found


def _scaling(axis: Axis) -> tuple[np.float32, np.float32]:
    """(factor, summand) from an axis to [-1, 1]."""
    scale = 2.0 / (axis.high - axis.low)
    return np.float32(scale), np.float32(-1.0 - axis.low * scale)


def _nested(coefficients: NDArray[np.float32], names: str, suffix: str) -> str:
    """'c0 + x*(c1 + x*c2)'."""
    if not names:
        return _number(float(coefficients)) + suffix
    terms = [_nested(c, names[1:], suffix) for c in coefficients]
    text = terms[-1]
    for term in reversed(terms[:-1]):
        text = f"{term} + {names[0]}*({text})"
    return f"({text})" if len(names) > 1 else text


def _number(value: float) -> str:
    """With as many digits as tell a float from all others."""
    return np.format_float_positional(np.float32(value), unique=True, trim="0")


def read(text: str) -> tuple[Way, int]:
    """'polynomial:6'. Raises UserError for anything else."""
    name, _, degree = text.partition(":")
    if name not in list(Way):
        raise UserError(unknown("fit", name, (f"{way}:DEGREE" for way in Way)))
    if not (degree.isascii() and degree.isdigit() and 1 <= int(degree) <= MOST_DEGREE):
        raise UserError(f"a fit needs a degree from 1 to {MOST_DEGREE}, as {name}:6, not {text!r}")
    return Way(name), int(degree)


def fitted(
    subject: Subject, terms: Terms, cells: Cells, way: Way, degree: int, threads: int = 1
) -> Fit:
    """The polynomials of all measures. Raises UserError where cells are too few for them."""
    axes = subject.axes
    if way is Way.CHEBYSHEV:
        nodes = [_on(axis, cheb.chebpts1(degree + 1)) for axis in axes]
        places: list[Point] = [tuple(map(float, p)) for p in itertools.product(*nodes)]
        values = at(subject, terms, places, threads).values
        values = values.reshape(-1, *[degree + 1] * len(axes))
    else:
        few = [axis.name for axis in axes if axis.size <= degree]
        if few:
            raise UserError(f"a polynomial of degree {degree} needs more values of {few[0]}")
        nodes, values = [np.array(axis.values()) for axis in axes], cells.values
    if not np.isfinite(values).all():
        raise UserError("no polynomial fits a table with values that are not finite")
    for k, (axis, x) in enumerate(zip(axes, nodes, strict=True)):
        made = np.linalg.pinv(cheb.chebvander(_off(axis, x), degree))
        along = np.tensordot(_powers(degree) @ made, values, (1, k + 1))
        values = np.moveaxis(along, 0, k + 1)
    return Fit(way, degree, values.astype(np.float32), axes)


def _powers(degree: int) -> Array:
    """From coefficients of Chebyshev's polynomials to those of powers, a column each."""
    made = np.zeros((degree + 1, degree + 1))
    for k in range(degree + 1):
        made[: k + 1, k] = cheb.cheb2poly([0.0] * k + [1.0])
    return made


def _on(axis: Axis, t: Array) -> Array:
    """From [-1, 1] to the axis' range; no viewer looks along the surface."""
    x = axis.low + 0.5 * (t + 1.0) * (axis.high - axis.low)
    return np.maximum(x, GRAZING) if axis.name == Angle.MU else x


def _off(axis: Axis, x: Array) -> Array:
    return 2.0 * (x - axis.low) / (axis.high - axis.low) - 1.0
