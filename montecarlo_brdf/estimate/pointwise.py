"""A model's functions on arrays of directions: compiled, for checks that look at many single
values.

Arrays of directions have the shape (n, 3), one unit vector per row.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.compile import kernel
from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import Layout, pack, unpacker
from montecarlo_brdf.compile.native import NativeKernel
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import paced
from montecarlo_brdf.model import Model

PARAMETERS: Any = None
FUNCTION: Any = None
WRITE: Any = None

TOGETHER = 256  # numbers in each LINE of a template that goes step by step
DRAWN = 4  # numbers per draw: x, y, z and the weight, NaN if the sampler returns none


def values(ints: Any, reals: Any, out: Any) -> None:
    """out[j] = FUNCTION(wo_j, wi_j, p); ints = (n, place of the first direction)."""
    p = PARAMETERS(reals)[0]
    for j in range(ints[0]):
        at = ints[1] + 6 * j
        wo = (reals[at], reals[at + 1], reals[at + 2])
        out[j] = FUNCTION(wo, (reals[at + 3], reals[at + 4], reals[at + 5]), p)


def draws(ints: Any, reals: Any, out: Any) -> None:
    """out[4 j ...] = FUNCTION(wo_j, u_j, p), a drawn direction and its weight."""
    p = PARAMETERS(reals)[0]
    for j in range(ints[0]):
        at = ints[1] + 6 * j
        wo = (reals[at], reals[at + 1], reals[at + 2])
        u = (reals[at + 3], reals[at + 4], reals[at + 5])
        WRITE(FUNCTION(wo, u, p), out, DRAWN * j)


def write_direction(w: Any, out: Any, at: Any) -> None:
    """A sampler that returns (x, y, z)."""
    out[at], out[at + 1], out[at + 2] = w[0], w[1], w[2]


def write_weighted(w: Any, out: Any, at: Any) -> None:
    """A sampler that returns (x, y, z, weight)."""
    out[at], out[at + 1], out[at + 2], out[at + 3] = w[0], w[1], w[2], w[3]


class Listing(NamedTuple):
    """All that a pointwise kernel is made of."""

    template: Any
    bound: Mapping[str, Any]
    layout: Layout

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        content = kernel.fingerprint(self.layout)
        content.add(self.template, self.bound)
        return content.hexdigest()

    def parts(self) -> Any:
        """Template, functions and layout."""
        return self.template, frozenset(self.bound.items()), self.layout

    def assemble(self, special: Specialiser) -> Any:
        """The template with everything bound."""
        unpack = unpacker(self.layout)
        made = {"PARAMETERS": unpack, "LINE": kernel.buffer(TOGETHER)}
        return special.clone(self.template, {**self.bound, **made})


class Pointwise:
    """f, sample and pdf of a model with one parameter set, on arrays."""

    def __init__(self, model: Model, p: Any) -> None:
        self.model = model.of(p)
        self.layout, self._numbers = pack([self.model.prepared(p)], 0)

    def f(self, wo: Any, wi: Any) -> Any:
        """f(wo, wi) in 1/sr: (n,) values for (n, 3) directions; wo or wi may be a single one."""
        return self._values(self.model.f, wo, wi)

    def pdf(self, wo: Any, wi: Any) -> Any:
        """pdf(wo, wi) in 1/sr."""
        return self._values(self.model.pdf, wo, wi)

    def sample(self, wo: Any, u: Any) -> tuple[Any, Any]:
        """Directions (n, 3) drawn for numbers u (n, 3), and their weights, NaN where none is
        returned."""
        from montecarlo_brdf.estimate.probe import returns_weight

        write = write_weighted if returns_weight(self.model) else write_direction
        bound = {"FUNCTION": self.model.sample, "WRITE": write}
        out = self._run(Listing(draws, bound, self.layout), wo, u, DRAWN)
        return out[:, :3], out[:, 3]

    def _values(self, function: Any, wo: Any, wi: Any) -> Any:
        return self._run(Listing(values, {"FUNCTION": function}, self.layout), wo, wi, 1)[:, 0]

    def _run(self, listing: Listing, a: Any, b: Any, width: int) -> Any:
        import numpy as np

        kernel: NativeKernel = compiled(self.model.name, listing)
        a, b = np.atleast_2d(a), np.atleast_2d(b)
        many, before = len(b) if len(a) == 1 else len(a), len(self._numbers)
        data = np.empty(before + 6 * many)
        pairs = data[before:].reshape(many, 6)
        data[:before], pairs[:, :3], pairs[:, 3:] = self._numbers, a, b
        out = np.full((many, width), np.nan)
        for k, count in paced.pieces(kernel, many):
            ints = np.array([count, before + 6 * k], dtype=np.int64)
            if kernel(ints.ctypes.data, data.ctypes.data, out[k:].ctypes.data) != 0:
                raise ModelError(f"model {self.model.name} raised an exception while evaluated")
        return out
