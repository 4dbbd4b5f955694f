"""The shapes of skies: their numbers, as they travel through kernels."""

from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.vectors import NORMAL, Vec


class Constant(NamedTuple):
    """L = 1."""

    one: float = 1.0


class Linear(NamedTuple):
    """L = a + b (w.u): a + b cos(theta), and every gradient between two poles."""

    a: float = 1.0
    b: float = 0.0
    axis: Vec = NORMAL


class Quadratic(NamedTuple):
    """L = (w.u)^2."""

    axis: Vec = NORMAL


class Cosine(NamedTuple):
    """L = max(0, w.u)^exponent."""

    exponent: float = 1.0
    axis: Vec = NORMAL


class Cap(NamedTuple):
    """L = 1 within an angle of the axis; depth = 1 - cos(angle)."""

    depth: float = 2.0
    axis: Vec = NORMAL


class Harmonics(NamedTuple):
    """L = sum of L_lm Y_lm, bands 0 to 4, 25 coefficients in the order l^2 + l + m."""

    coefficients: tuple[float, ...] = (0.0,) * 25


class Image(NamedTuple):
    """Texels of a latitude-longitude image; `address` is that of their doubles in memory."""

    address: float = 0.0
    table: float = 0.0  # of the cumulative distribution for sampling
    width: float = 0.0
    height: float = 0.0
    content: float = 0.0  # a hash: what the image shows, wherever it lies
