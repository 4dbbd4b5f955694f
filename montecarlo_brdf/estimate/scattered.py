"""A model at many places at once, each with a direction and parameters of its own: for searches.

A mean estimated place by place spends its time between the calls. Here one call takes thousands of
places, and the same nodes u serve all of them: differences between places are not noise.
"""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.compile import kernel
from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import (
    Layout,
    following,
    numbers_of,
    place_row,
    shape_of,
    unpacker,
)
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import integrands, paced
from montecarlo_brdf.estimate.samplers import integrand_name, samplers_of
from montecarlo_brdf.estimate.slopes import albedo_slopes, reverse_slopes
from montecarlo_brdf.estimate.subject import functions_of
from montecarlo_brdf.model import Model

PARAMETERS: Any = None
INTEGRAND: Any = None
FUNCTION: Any = None
ROW: Any = None
LINE: Any = None

NODE = 4  # numbers of a node: u[0], u[1], u[4] and its weight
PLACE = 4  # numbers of a place before its parameters: a direction and what the integrand needs
CHUNK = 1024  # nodes of a call
TOGETHER = 256  # nodes in each LINE


def means(ints: Any, reals: Any, out: Any) -> None:
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


def pairs(ints: Any, reals: Any, out: Any) -> None:
    """out[j] = FUNCTION(wo_j, wi_j, p_j); ints = (pairs, 1, place of the first, numbers of one)."""
    for j in range(ints[0]):
        at = ROW(reals, ints[2] + j * ints[3])
        p = PARAMETERS(at)[0]
        out[j] = FUNCTION((at[0], at[1], at[2]), (at[3], at[4], at[5]), p)


class Listing(NamedTuple):
    """All that a kernel over places is made of."""

    template: Any  # means or pairs
    function: Any  # an integrand, or f
    functions: Mapping[str, Any]  # what F, SAMPLE, PDF stand for in it
    layout: Layout

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        content = kernel.fingerprint(self.layout)
        content.add(self.template)
        content.add(self.function, self.functions)
        return content.hexdigest()

    def parts(self) -> Any:
        """Template, functions and layout."""
        return self.template, self.function, frozenset(self.functions.items()), self.layout

    def assemble(self, special: Specialiser) -> Any:
        """The template with everything bound."""
        name = "INTEGRAND" if self.template is means else "FUNCTION"
        function = special.bind(self.function, self.functions) if self.functions else self.function
        unpack = unpacker(self.layout)
        return special.clone(
            self.template,
            {
                name: function,
                "PARAMETERS": unpack,
                "ROW": place_row(),
                "LINE": kernel.buffer(TOGETHER),
            },
        )


class Rows(NamedTuple):
    """Parameter sets as rows of numbers, one per place, as a kernel takes them."""

    base: Any
    values: Any  # (n, parameters)
    shape: Any
    numbers: Any  # (n, numbers of a set as the model gets it)

    def columns(self, fields: Any) -> dict[str, Any]:
        """The columns whose names another NamedTuple has too."""
        names = self.base._fields
        return {n: self.values[:, names.index(n)] for n in fields._fields if n in names}

    def parameters(self, k: int) -> Any:
        """The parameter set of row k."""
        return type(self.base)(*map(float, self.values[k]))


def rows(model: Model, columns: Mapping[str, Any], base: Any, n: int) -> Rows:
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
    ready = [model.prepared(type(base)(*map(float, s))) for s in sets]
    numbers = np.array([list(numbers_of(r)) for r in ready])
    return Rows(base, table, shape_of(ready[0]), numbers[which.reshape(-1)])


def mean_values(model: Model, quantity: str, nodes: Any, places: Any, sets: Rows) -> Any:
    """A ("albedo") or R ("reverse") at (n, 4) places: by the model's own sampler with nodes in
    [0, 1)^3, or in slopes of the half vector where it has none."""
    name = integrand_name(model, quantity, "own")
    own = samplers_of(model, quantity)[-1] == "own"
    slopes_of = albedo_slopes if quantity == "albedo" else reverse_slopes
    function = getattr(integrands, name) if own else slopes_of
    return _run(model, (means, function, functions_of(model)), nodes, places, sets)


def pair_values(model: Model, wo: Any, wi: Any, sets: Rows) -> Any:
    """f(wo, wi) for (n, 3) directions, each pair with parameters of its own."""
    import numpy as np

    places = np.concatenate([wo, wi], axis=1)
    return _run(model, (pairs, model.f, {}), np.zeros((0, NODE)), places, sets)


def _run(model: Model, made_of: tuple[Any, Any, Any], nodes: Any, places: Any, sets: Rows) -> Any:
    import numpy as np

    layout = following(sets.shape, places.shape[1])
    kernel = compiled(model.name, Listing(*made_of, layout))
    table = np.concatenate([places, sets.numbers], axis=1)
    stride = table.shape[1]
    data = np.ascontiguousarray(np.concatenate([nodes.ravel(), table.ravel()]), dtype=np.float64)
    out = np.zeros(len(places))
    for node in range(0, max(1, len(nodes)), CHUNK):
        many = max(1, min(CHUNK, len(nodes) - node))
        for start, count in paced.pieces(kernel, len(places), many):
            first = nodes.size + start * stride
            ints = np.array([count, many, first, stride, NODE * node], dtype=np.int64)
            if kernel(ints.ctypes.data, data.ctypes.data, out[start:].ctypes.data) != 0:
                raise ModelError(f"model {model.name} raised an exception while evaluated")
    return out
