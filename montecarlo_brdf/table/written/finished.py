"""A table that is done: plain data, from which files are made."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.table.axes import Axis

Array = NDArray[np.float64]


class Number(StrEnum):
    """The type of numbers in a file for programs."""

    FLOAT = "float"
    HALF = "half"


class Finished(NamedTuple):
    """Values and certificates, (cells along each axis), by the names of quantities."""

    title: str  # the model with its parameters
    axes: tuple[Axis, ...]
    values: Mapping[str, Array]
    errors: Mapping[str, Array]
    facts: Mapping[str, Any]  # how it was made


def rounded(values: Array, number: Number) -> NDArray[Any]:
    """As a file keeps them."""
    return values.astype(np.float16 if number is Number.HALF else np.float32)


def bound(table: Finished, name: str, number: Number) -> float:
    """How far a number of the file is from the truth at most, rounding included."""
    exact = table.values[name]
    kept = rounded(exact, number).astype(np.float64)
    return float(np.max(np.abs(kept - exact) + table.errors[name]))
