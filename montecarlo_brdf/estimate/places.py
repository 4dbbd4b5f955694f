"""A model at many places in one call: compiled, for checks and searches that look at many values.

`Pointwise` is a model with one parameter set on arrays of directions, (n, 3), one unit vector per
row. For searches every place has parameters of its own: a mean estimated place by place spends its
time between the calls; here one call takes thousands of places, and the same nodes u serve all of
them, so that differences between places are not noise.
"""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.compile.bind import Function, Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import (
    Buffer,
    Row,
    Shape,
    Unpack,
    following,
    numbers_of,
    pack,
    shape_of,
)
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand, samplers_of, weighted
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.directions import Sampler

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

PARAMETERS: Any = hole()
INTEGRAND: Any = hole()
FUNCTION: Any = hole()
WRITE: Any = hole()
ROW: Any = hole()
LINE: Any = hole()

DRAWN = 4  # numbers per draw: x, y, z and the weight, NaN if the sampler returns none
NODE = 4  # numbers of a node: u[0], u[1], u[4] and its weight
PLACE = 4  # numbers of a place before its parameters: a direction and what the integrand needs
CHUNK = 1024  # nodes of a call
TOGETHER = 256  # nodes in each LINE


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


def means(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] += sum_i w_i INTEGRAND(u_i, place_j, p_j); ints = (places, nodes, place of the first
    place, numbers of a place, place of the first node)."""
    u0, u1, u4, x = LINE(), LINE(), LINE(), LINE()
    for first in range(0, ints[1], TOGETHER):
        m = TOGETHER if ints[1] - first > TOGETHER else ints[1] - first
        weights = ROW(reals, ints[4] + NODE * first)
        for i in range(m):
            u0[i], u1[i], u4[i] = weights[NODE * i], weights[NODE * i + 1], weights[NODE * i + 2]
        for j in range(ints[0]):
            place = ROW(reals, ints[2] + j * ints[3])
            p = PARAMETERS(place)[0]
            query = (place[0], place[1], place[2], place[3])
            for i in range(m):
                x[i] = INTEGRAND((u0[i], u1[i], 0.0, 0.0, u4[i]), query, p)
            total = 0.0
            for i in range(m):
                total += weights[NODE * i + 3] * x[i]
            out[j] += total


def pairs(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] = FUNCTION(wo_j, wi_j, p_j); ints = (pairs, 1, place of the first, numbers of one)."""
    for j in range(ints[0]):
        at = ROW(reals, ints[2] + j * ints[3])
        p = PARAMETERS(at)[0]
        out[j] = FUNCTION((at[0], at[1], at[2]), (at[3], at[4], at[5]), p)


class Rows(NamedTuple):
    """Parameter sets as rows of numbers, one per place, as a kernel takes them."""

    base: ParameterSet
    values: Array  # (n, parameters)
    shape: Shape
    numbers: Array  # (n, numbers of a set as the model gets it)

    def columns(self, fields: type[ParameterSet]) -> dict[str, Array]:
        """The columns whose names another NamedTuple has too."""
        names = self.base._fields
        return {n: self.values[:, names.index(n)] for n in fields._fields if n in names}

    def parameters(self, k: int) -> Any:
        """The parameter set of row k."""
        return self.base._make(map(float, self.values[k]))


def parameter_rows(model: Model, columns: Mapping[str, Any], base: ParameterSet, n: int) -> Rows:
    """n parameter sets: `base` with the columns of n numbers in place of some fields.

    A model that prepares its parameters does so once per different set.
    """
    import numpy as np

    table = np.tile(np.array(tuple(base), dtype=float), (n, 1)) if base else np.zeros((n, 0))
    for name, values in columns.items():
        table[:, base._fields.index(name)] = values
    if model.prepare is None:
        return Rows(base, table, shape_of(base), table)
    sets, which = np.unique(table, axis=0, return_inverse=True)
    ready = [model.prepared(base._make(map(float, s))) for s in sets]
    numbers = np.array([list(numbers_of(r)) for r in ready])
    return Rows(base, table, shape_of(ready[0]), numbers[which.reshape(-1)])


def mean_values(model: Model, of: Quantity, nodes: Array, places: Array, sets: Rows) -> Array:
    """A or R at (n, 4) places: by the model's own sampler with nodes in [0, 1)^3, or in slopes of
    the half vector where it has none."""
    own = Sampler.OWN in samplers_of(model, of)
    mean = integrand(model, of, Sampler.OWN if own else Sampler.SLOPES)
    names = {"INTEGRAND": mean.template, "LINE": Buffer(TOGETHER), "ROW": Row()}
    unpack = Unpack(following(sets.shape, places.shape[1]))
    return _run(kernel(model.name, means, PARAMETERS=unpack, **names), nodes, places, sets)


def pair_values(model: Model, wo: Array, wi: Array, sets: Rows) -> Array:
    """f(wo, wi) for (n, 3) directions, each pair with parameters of its own."""
    import numpy as np

    places = np.concatenate([wo, wi], axis=1)
    unpack = Unpack(following(sets.shape, places.shape[1]))
    call = kernel(model.name, pairs, PARAMETERS=unpack, FUNCTION=model.f, ROW=Row())
    return _run(call, np.zeros((0, NODE)), places, sets)


def _run(call: Kernel, nodes: Array, places: Array, sets: Rows) -> Array:
    import numpy as np

    table = np.concatenate([places, sets.numbers], axis=1)
    stride = table.shape[1]
    data = np.ascontiguousarray(np.concatenate([nodes.ravel(), table.ravel()]), dtype=np.float64)
    out = np.zeros(len(places))
    for node in range(0, max(1, len(nodes)), CHUNK):
        many = max(1, min(CHUNK, len(nodes) - node))
        for start, count in call.pieces(len(places), many):
            first = nodes.size + start * stride
            call.on([count, many, first, stride, NODE * node], data, out[start:])
    return out
