"""A model's functions on arrays of directions: compiled, for checks that look at many single
values.

Arrays of directions have the shape (n, 3), one unit vector per row.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.compile.bind import Function, Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.compile.layout import Unpack, pack
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.model import Model, ParameterSet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

PARAMETERS: Any = hole()
FUNCTION: Any = hole()
WRITE: Any = hole()

DRAWN = 4  # numbers per draw: x, y, z and the weight, NaN if the sampler returns none


def values(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] = FUNCTION(wo_j, wi_j, p); ints = (n, place of the first direction)."""
    p = PARAMETERS(reals)[0]
    for j in range(ints[0]):
        at = ints[1] + 6 * j
        wo = (reals[at], reals[at + 1], reals[at + 2])
        out[j] = FUNCTION(wo, (reals[at + 3], reals[at + 4], reals[at + 5]), p)


def draws(ints: Ints, reals: Reals, out: Out) -> None:
    """out[4 j ...] = FUNCTION(wo_j, u_j, p), a drawn direction and its weight."""
    p = PARAMETERS(reals)[0]
    for j in range(ints[0]):
        at = ints[1] + 6 * j
        wo = (reals[at], reals[at + 1], reals[at + 2])
        u = (reals[at + 3], reals[at + 4], reals[at + 5])
        WRITE(FUNCTION(wo, u, p), out, DRAWN * j)


def write_direction(w: Sequence[float], out: Out, at: int) -> None:
    """A sampler that returns (x, y, z)."""
    out[at], out[at + 1], out[at + 2] = w[0], w[1], w[2]


def write_weighted(w: Sequence[float], out: Out, at: int) -> None:
    """A sampler that returns (x, y, z, weight)."""
    out[at], out[at + 1], out[at + 2], out[at + 3] = w[0], w[1], w[2], w[3]


class Pointwise:
    """f, sample and pdf of a model with one parameter set, on arrays."""

    def __init__(self, model: Model, p: ParameterSet) -> None:
        self.model = model.of(p)
        layout, self._numbers = pack([self.model.prepared(p)], 0)
        self._unpack = Unpack(layout)

    def f(self, wo: ArrayLike, wi: ArrayLike) -> Array:
        """f(wo, wi) in 1/sr: (n,) values for (n, 3) directions; wo or wi may be a single one."""
        return self._run(values, wo, wi, 1, FUNCTION=self.model.f)[:, 0]

    def pdf(self, wo: ArrayLike, wi: ArrayLike) -> Array:
        """pdf(wo, wi) in 1/sr."""
        return self._run(values, wo, wi, 1, FUNCTION=self.model.pdf)[:, 0]

    def sample(self, wo: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        """Directions (n, 3) drawn for numbers u (n, 3), and their weights, NaN where none is
        returned."""
        write = write_weighted if weighted(self.model) else write_direction
        out = self._run(draws, wo, u, DRAWN, FUNCTION=self.model.sample, WRITE=write)
        return out[:, :3], out[:, 3]

    def _run(
        self, template: Function, a: ArrayLike, b: ArrayLike, width: int, **names: object
    ) -> Array:
        import numpy as np

        call = kernel(self.model.name, template, PARAMETERS=self._unpack, **names)
        a, b = np.atleast_2d(a), np.atleast_2d(b)
        many, before = len(b) if len(a) == 1 else len(a), len(self._numbers)
        data = np.empty(before + 6 * many)
        pairs = data[before:].reshape(many, 6)
        data[:before], pairs[:, :3], pairs[:, 3:] = self._numbers, a, b
        out = np.full((many, width), np.nan)
        for k, count in call.pieces(many):
            call.on([count, before + 6 * k], data, out[k:])
        return out
