"""A model at many places in one call: compiled, for checks and searches that look at many values.

Directions are arrays (n, 3), one unit vector per row; every row has parameters of its own (`Rows`),
or all share one set (`Pointwise`). For searches: a mean estimated place by place spends its
time between the calls; here one call takes thousands of places, and the same nodes u serve all of
them, so that differences between places are not noise.
"""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from montecarlo_brdf.compile.bind import Called, Function, Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import (
    Buffer,
    Row,
    Shape,
    Unpack,
    following,
    numbers_of,
    shape_of,
)
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import functions_of, integrand, samplers_of, weighted
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.directions import Sampler

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Index = NDArray[np.integer[Any]]

PARAMETERS: Any = hole()
INTEGRAND: Any = hole()
FUNCTION: Any = hole()
WRITE: Any = hole()
ROW: Any = hole()
LINE: Any = hole()

PAIR = 7  # two directions, or a direction and its u, and where the parameters are
DRAWN = 4  # numbers per draw: x, y, z and the weight, NaN if the sampler returns none
NODE = 4  # numbers of a node: u[0], u[1], u[4] and its weight
PLACE = 4  # numbers of a place before its parameters: a direction and what the integrand needs
CHUNK = 1024  # nodes of a call
TOGETHER = 256  # nodes in each LINE


def values(ints: Ints, reals: Reals, out: Out) -> None:
    """out[j] = FUNCTION(wo_j, wi_j, p_j); ints = (rows, place of the first), and in each row two
    directions and the place of its parameters: many rows may share a set, which may be long."""
    for j in range(ints[0]):
        at = ROW(reals, ints[1] + PAIR * j)
        p = PARAMETERS(ROW(reals, int(at[6])))[0]
        out[j] = FUNCTION((at[0], at[1], at[2]), (at[3], at[4], at[5]), p)


def draws(ints: Ints, reals: Reals, out: Out) -> None:
    """out[4 j ...] = FUNCTION(wo_j, u_j, p_j), a drawn direction and its weight; ints as there."""
    for j in range(ints[0]):
        at = ROW(reals, ints[1] + PAIR * j)
        p = PARAMETERS(ROW(reals, int(at[6])))[0]
        WRITE(FUNCTION((at[0], at[1], at[2]), (at[3], at[4], at[5]), p), out, DRAWN * j)


def write_direction(w: Sequence[float], out: Out, at: int) -> None:
    """A sampler that returns (x, y, z)."""
    out[at], out[at + 1], out[at + 2] = w[0], w[1], w[2]


def write_weighted(w: Sequence[float], out: Out, at: int) -> None:
    """A sampler that returns (x, y, z, weight)."""
    out[at], out[at + 1], out[at + 2], out[at + 3] = w[0], w[1], w[2], w[3]


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


class Rows(NamedTuple):
    """Parameter sets as rows of numbers, one per place or one for all, as a kernel takes them."""

    base: ParameterSet
    values: Array  # (n, parameters)
    shape: Shape
    sets: Array  # (m, numbers of a set as the model gets it)
    which: Index  # (n,) places in `sets`

    @property
    def numbers(self) -> Array:
        """(n, numbers of a set)."""
        found: Array = self.sets[self.which]
        return found

    def columns(self, fields: type[ParameterSet]) -> dict[str, Array]:
        """The columns whose names another NamedTuple has too."""
        names = self.base._fields
        return {n: self.values[:, names.index(n)] for n in fields._fields if n in names}

    def parameters(self, k: int) -> Any:
        """The parameter set of row k."""
        return self.base._make(map(float, self.values[k]))

    def at(self, index: Index | slice) -> Rows:
        """Some of the rows, in any order and as often as the index says."""
        return self._replace(values=self.values[index], which=self.which[index])


def parameter_rows(model: Model, columns: Mapping[str, Any], base: ParameterSet, n: int) -> Rows:
    """n parameter sets: `base` with the columns of n numbers in place of some fields.

    A model that prepares its parameters does so once per different set.
    """
    import numpy as np

    table = np.tile(np.array(tuple(base), dtype=float), (n, 1)) if base else np.zeros((n, 0))
    for name, values in columns.items():
        table[:, base._fields.index(name)] = values
    return rows_of(model, base, table)


def rows_of(model: Model, base: ParameterSet, table: Array) -> Rows:
    """The parameter sets of the rows of a table, in the order of the fields of `base`."""
    import numpy as np

    if model.prepare is None:
        return Rows(base, table, shape_of(base), table, np.arange(len(table)))
    if not base:
        one = model.prepared(base)
        numbers = np.array([list(numbers_of(one))])
        return Rows(base, table, shape_of(one), numbers, np.zeros(len(table), dtype=np.intp))
    table = np.ascontiguousarray(table)
    words = table.view(np.dtype((np.void, table.itemsize * table.shape[1]))).ravel()
    _, first, which = np.unique(words, return_index=True, return_inverse=True)
    ready = [model.prepared(base._make(map(float, table[k]))) for k in first]
    numbers = np.array([list(numbers_of(r)) for r in ready])
    return Rows(base, table, shape_of(ready[0]), numbers, which.reshape(-1))


def values_of(model: Model, function: Function, wo: ArrayLike, wi: ArrayLike, sets: Rows) -> Array:
    """f or pdf of a model, in 1/sr: (n,) values for (n, 3) directions, each pair with parameters of
    its own or all with one set; wo or wi may be a single one."""
    return _run(model, values, wo, wi, sets, 1, FUNCTION=Called(function))[:, 0]


def draws_of(model: Model, wo: ArrayLike, u: ArrayLike, sets: Rows) -> tuple[Array, Array]:
    """Directions (n, 3) drawn for numbers u (n, 3), and their weights, NaN where none is
    returned."""
    write = write_weighted if weighted(model) else write_direction
    sample = functions_of(model)["SAMPLE"]
    out = _run(model, draws, wo, u, sets, DRAWN, FUNCTION=sample, WRITE=write)
    return out[:, :3], out[:, 3]


def _run(
    model: Model, template: Function, a: ArrayLike, b: ArrayLike, sets: Rows, width: int,
    **names: object,
) -> Array:  # fmt: skip
    import numpy as np

    unpack = Unpack(following(sets.shape, 0))
    call = kernel(model.name, template, PARAMETERS=unpack, ROW=Row(), **names)
    a, b = np.atleast_2d(a), np.atleast_2d(b)
    many = len(b) if len(a) == 1 else len(a)
    first = PAIR * many
    data = np.empty(first + sets.sets.size)
    pairs = data[:first].reshape(many, PAIR)
    pairs[:, :3], pairs[:, 3:6], data[first:] = a, b, sets.sets.ravel()
    pairs[:, 6] = first + sets.sets.shape[1] * sets.which
    out = np.full((many, width), np.nan)
    for k, count in call.pieces(many):
        call.on([count, PAIR * k], data, out[k:])
    return out


class Pointwise:
    """f, sample and pdf of a model with one parameter set, on arrays."""

    def __init__(self, model: Model, p: ParameterSet) -> None:
        import numpy as np

        self.model = model.of(p)
        self.sets = rows_of(self.model, p, np.array([tuple(p)], dtype=float))

    def f(self, wo: ArrayLike, wi: ArrayLike) -> Array:
        """f(wo, wi) in 1/sr, see `values_of`."""
        return values_of(self.model, self.model.f, wo, wi, self.sets)

    def pdf(self, wo: ArrayLike, wi: ArrayLike) -> Array:
        """pdf(wo, wi) in 1/sr, see `values_of`; of a model that has one."""
        return values_of(self.model, cast(Function, self.model.pdf), wo, wi, self.sets)

    def sample(self, wo: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        """Directions and weights, see `draws_of`."""
        return draws_of(self.model, wo, u, self.sets)


def seeing(model: Model, of: Quantity) -> Sampler:
    """The model's own sampler, or slopes of half vectors where it has none."""
    return Sampler.OWN if Sampler.OWN in samplers_of(model, of) else Sampler.SLOPES


def mean_values(
    model: Model, of: Quantity, by: Sampler, nodes: Array, places: Array, sets: Rows
) -> Array:
    """A, R or int pdf at (n, 4) places: nodes are numbers in [0, 1)^3 of the model's own sampler,
    or (slope, azimuth, 0) of the half vector, each with its weight."""
    mean = integrand(model, of, by)
    names = {"INTEGRAND": mean.template, "LINE": Buffer(TOGETHER), "ROW": Row()}
    unpack = Unpack(following(sets.shape, places.shape[1]))
    return _means(kernel(model.name, means, PARAMETERS=unpack, **names), nodes, places, sets)


def _means(call: Kernel, nodes: Array, places: Array, sets: Rows) -> Array:
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
