"""What formulas of reflection are made of, for many pairs of directions at once."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

TINY = 1e-300
Exponents = tuple[int, int, int, int]
NAMES = ("cos_i", "cos_o", "n.h", "wo.h")
NONE: Exponents = (0, 0, 0, 0)


class Geometry(NamedTuple):
    """Directions (n, 3), and the cosines between them, the normal and the half vector (n,)."""

    wo: Array
    wi: Array
    h: Array
    cos_i: Array
    cos_o: Array
    normal_half: Array
    out_half: Array
    mirror: Array  # of wi and the mirror direction of wo, at least 0

    @property
    def cosines(self) -> tuple[Array, Array, Array, Array]:
        """In the order of `NAMES`."""
        return self.cos_i, self.cos_o, self.normal_half, self.out_half

    def swapped(self) -> Geometry:
        """With wo and wi exchanged."""
        return geometry(self.wi, self.wo)


def geometry(wo: Array, wi: Array) -> Geometry:
    """Of (3,) or (n, 3) directions; one of them many."""
    wo, wi = np.broadcast_arrays(wo, wi)
    h = wo + wi
    h = h / np.maximum(np.sqrt(np.sum(h * h, axis=1)), TINY)[:, None]
    mirror = wo[:, 2] * wi[:, 2] - wo[:, 0] * wi[:, 0] - wo[:, 1] * wi[:, 1]
    out_half = np.maximum(np.sum(wo * h, axis=1), TINY)
    return Geometry(
        wo, wi, h, wi[:, 2], wo[:, 2], h[:, 2], out_half, np.maximum(mirror, 0.0)
    )


def monomial(g: Geometry, e: Exponents) -> Array:
    """The product of powers of the cosines."""
    out = np.ones(len(g.wi))
    for cosine, power in zip(g.cosines, e, strict=True):
        if power:
            out = out * np.maximum(cosine, TINY) ** power
    return out


def _shapes() -> tuple[Exponents, ...]:
    found: list[Exponents] = [*itertools.product((-1, 0, 1), repeat=4)]  # type: ignore[list-item]
    found += [(0, 0, 2, 0), (0, 0, -2, 0), (0, 0, 0, 2), (0, 0, 0, -2), (-2, 0, 0, 0), (2, 0, 0, 0)]
    found += [(0, 0, 4, 0), (0, 0, -4, 0)]
    return tuple(sorted(found, key=lambda e: (sum(map(abs, e)), -sum(e))))


#: the monomials that a factor may be, few cosines first
SHAPES = _shapes()


def cost(e: Exponents) -> int:
    """How many cosines a monomial has."""
    return sum(map(abs, e))


def turned(w: Array, angle: float) -> Array:
    """(n, 3) directions about the normal, by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    w = np.atleast_2d(w)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=1)
