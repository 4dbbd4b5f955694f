"""A model's own functions in any precision."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from montecarlo_brdf.arithmetic.batch import Batch, Mixed, Table, Widened, over_points
from montecarlo_brdf.arithmetic.elementary import Rebound
from montecarlo_brdf.arithmetic.types import Arithmetic, Array
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.model import Model


class Rung:
    """f, sample and pdf of a model in one precision.

    Directions are arrays (n, 3); parameters a NamedTuple whose fields are numbers or arrays (n,),
    all rounded to the precision already.
    """

    def __init__(self, model: Model, arithmetic: Arithmetic) -> None:
        self.model = model
        self.arithmetic = arithmetic
        self._special = Rebound(arithmetic)
        self._rebound: dict[str, Callable[..., Any]] = {}

    def f(self, wo: Array, wi: Array, p: NamedTuple) -> Array:
        """f(wo, wi, p) per point."""
        return np.asarray(self._called("f", wo, wi, p)[0])

    def pdf(self, wo: Array, wi: Array, p: NamedTuple) -> Array:
        """pdf(wo, wi, p) per point."""
        return np.asarray(self._called("pdf", wo, wi, p)[0])

    def sample(self, wo: Array, u: Array, p: NamedTuple) -> Array:
        """Rows x, y, z (and weight) drawn for the numbers u (n, 3)."""
        return self._called("sample", wo, u, p)

    def function(self, name: str) -> Callable[..., Any]:
        """The model's function `name`, with everything it reaches bound to this precision."""
        if name not in self._rebound:
            original = getattr(self.model, name)
            self._rebound[name] = self._special.clone(getattr(original, "py_func", original), {})
        return self._rebound[name]

    def _called(self, name: str, a: Array, b: Array, p: NamedTuple) -> Array:
        function = self.function(name)
        prepare = self._prepare(p)
        columns = [*self._columns(a), *self._columns(b)]
        columns += [self.arithmetic.array(v) for v in p] if callable(prepare) else []

        def call(*row: Batch) -> Any:
            ready = prepare(p._make(row[6:])) if callable(prepare) else prepare
            return function(row[:3], row[3:6], ready)

        try:
            return np.asarray(over_points(columns, call, self.arithmetic))
        except Widened as error:
            raise ModelError(
                f"{name} of model {self.model.name} leaves its precision: {error}"
            ) from error
        except NotImplementedError as error:  # of a function of C
            raise ModelError(
                f"model {self.model.name} is machine code: it runs in its own precision alone"
            ) from error
        except (TypeError, ValueError, AttributeError, IndexError, AssertionError) as error:
            text = " ".join(str(error).split())
            raise ModelError(
                f"{name} of model {self.model.name} cannot run in {self.arithmetic}: {text}"
            ) from error

    def _columns(self, vectors: Array) -> list[Any]:
        return [self.arithmetic.array(column) for column in np.asarray(vectors).T]

    def _prepare(self, p: NamedTuple) -> Any:
        """What turns parameters into what the functions get: a function, or that itself.

        A `prepare` that only works on plain floats (tables, loops) runs in double, like the part of
        a renderer that runs once; its results are rounded.
        """
        if self.model.prepare is None:
            return lambda q: q
        prepare = self.function("prepare")
        try:
            prepare(p._make(Batch(self.arithmetic.array(v), self.arithmetic) for v in p))
        except Mixed:
            return prepare
        except Exception:
            return self._rounded(_in_double(self.model.prepare, p._make(float(v) for v in p)))
        return prepare

    def _rounded(self, ready: NamedTuple) -> Any:
        """Doubles in a NamedTuple as numbers of this precision, tables as tables of them."""
        return ready._make(_in(self.arithmetic, v) for v in ready)


@functools.lru_cache(maxsize=64)
def _in_double(prepare: Callable[[Any], Any], p: NamedTuple) -> Any:
    """prepare(p), which may take long, once for all precisions."""
    return prepare(p)


def _in(arithmetic: Arithmetic, value: ArrayLike) -> Any:
    if isinstance(value, int | float):
        return Batch(arithmetic.array(value), arithmetic)
    return Table(arithmetic.array(value), arithmetic)


def rounded(p: NamedTuple, arithmetic: Arithmetic) -> Any:
    """A parameter set rounded to a precision, as long as it stays finite; else None."""
    values = [arithmetic.array(v) for v in p]
    if arithmetic.name != "exact" and not all(math.isfinite(float(v)) for v in values):
        return None
    return p._make(values)


def unit(w: Array, arithmetic: Arithmetic) -> Array:
    """Directions (n, 3) of exactly unit length as nearly as the precision has it."""
    w = arithmetic.array(w)
    scale = arithmetic.function("sqrt")(w[:, 0] ** 2 + w[:, 1] ** 2 + w[:, 2] ** 2)
    return np.asarray(w / scale[:, None])
