"""Many points and directions at once, through the same compiled functions that kernels use."""
from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numba
import numpy as np

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile import compiler
from montecarlo_brdf.compile.bind import hole
from montecarlo_brdf.sampling import points as sets

POINTS: Any = hole()
WARP: Any = hole()
WIDTH: Any = hole()


def fill(key: Any, start: int, shape: Any, out: Any) -> None:
    for i in range(out.shape[0]):
        u = POINTS(key, u64(start + i), shape)
        for a in range(5):
            out[i, a] = u[a]


def warp(u1: Any, u2: Any, out: Any) -> None:
    for i in range(u1.size):
        w = WARP(u1[i], u2[i])
        for a in range(WIDTH):
            out[i, a] = w[a]


@functools.cache
def compiled(template: Callable[..., None], **bound: Any) -> Any:
    specialiser = compiler.specialiser(compiler.compiled)
    return numba.njit(**compiler.options())(specialiser.clone(template, bound))


def shape_of(name: str, count: int) -> sets.Shape:
    return sets.SHAPES[name](count) if name in sets.SHAPES else sets.NONE


def points(name: str, key: int, start: int, count: int, size: int | None = None) -> Any:
    """Points [start, start + count) of a named set (of `size` points) as an array (count, 5)."""
    out = np.empty((count, 5))
    shape = tuple(map(np.uint64, shape_of(name, size or count)))
    compiled(fill, POINTS=getattr(sets, name))(np.uint64(key), start, shape, out)
    return out


def warped(function: Callable[..., Any], u1: Any, u2: Any) -> Any:
    """The coordinates function(u1, u2), one column each."""
    width = len(function(0.3, 0.6))
    out = np.empty((u1.size, width))
    compiled(warp, WARP=function, WIDTH=width)(u1, u2, out)
    return out
