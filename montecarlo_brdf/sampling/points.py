"""Point sets: uniform numbers in [0, 1)^5 from a 64-bit key and an index, with no state.

A point depends on nothing but (key, index, shape of the set): any order, any number of threads,
the same numbers. A key stands for one randomisation; replicates use different keys. Coordinates
that a kernel does not use cost nothing: the compiler removes them.
"""
from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

from montecarlo_brdf.sampling.independent import independent, independent_axis
from montecarlo_brdf.sampling.keys import NONE, Point, Shape, axis_key, replicate_key
from montecarlo_brdf.sampling.lattice import GENERATORS, generator, lattice
from montecarlo_brdf.sampling.sobol import (
    owen_reversed,
    pascal_reversed,
    scrambled,
    sobol,
    sobol_pair,
    sobol_plane,
    sobol_shuffled,
)
from montecarlo_brdf.sampling.stratified import grid, stratified

__all__ = [
    "DIMENSIONS", "NONE", "Point", "PointSet", "SETS", "SHAPES", "Shape", "axis_key", "counted",
    "independent", "independent_axis", "lattice", "owen_reversed", "pascal_reversed",
    "replicate_key", "scrambled", "sobol", "sobol_pair", "sobol_plane", "sobol_shuffled",
    "stratified",
]  # fmt: skip


class PointSet(StrEnum):
    """How the points of one randomisation lie: each has a function of its name here."""

    INDEPENDENT = "independent"
    STRATIFIED = "stratified"
    SOBOL = "sobol"
    LATTICE = "lattice"


#: largest number of points per replicate, and whether it must be a power of two
SETS: dict[str, tuple[int, bool]] = {
    PointSet.INDEPENDENT: (1 << 62, False),
    PointSet.STRATIFIED: (1 << 32, True),
    PointSet.SOBOL: (1 << 32, True),
    PointSet.LATTICE: (1 << max(GENERATORS, default=0), True),
}
#: what must be known of a set before its points: from its number of points
SHAPES: dict[str, Callable[[int], Shape]] = {
    PointSet.STRATIFIED: grid,
    PointSet.LATTICE: generator,
}

DIMENSIONS = 5


def counted(key: int, index: int, shape: Shape = NONE) -> Point:
    """No points but the index itself: for integrands that look at chosen directions."""
    return 1.0 * index, 0.0, 0.0, 0.0, 0.0
