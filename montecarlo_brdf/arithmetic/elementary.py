"""Elementary functions in every type: what stands for `math`, and for our polynomials.

The polynomials of `special` and their bit tricks are made for doubles. In double they run as they
are, on words of 64 bits; in any other type the type's own exp, log, sin, cos stand for them, as
they would on a processor of that precision.
"""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from montecarlo_brdf import bits, special
from montecarlo_brdf.arithmetic.batch import Batch, Table, Whole
from montecarlo_brdf.arithmetic.types import Arithmetic
from montecarlo_brdf.compile.bind import Specialiser

#: Functions of `math` and NumPy's names for them.
NAMES = {
    "sqrt": "sqrt", "exp": "exp", "exp2": "exp2", "expm1": "expm1", "log": "log", "log2": "log2",
    "log10": "log10", "log1p": "log1p", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "arcsin",
    "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "sinh": "sinh", "cosh": "cosh",
    "tanh": "tanh", "pow": "power", "fabs": "absolute", "hypot": "hypot", "copysign": "copysign",
    "floor": "floor", "ceil": "ceil", "trunc": "trunc", "fmod": "fmod", "radians": "radians",
    "degrees": "degrees", "isfinite": "isfinite", "isnan": "isnan", "isinf": "isinf",
}  # fmt: skip


def twins(arithmetic: Arithmetic) -> dict[Any, Any]:
    """What stands for the functions of `math`, `numpy`, `special` and `bits` in a type."""

    def twin(name: str) -> Callable[..., Any]:
        def function(*operands: object) -> Any:
            batch = next((o for o in operands if isinstance(o, Batch)), None)
            if batch is None:
                batch = Batch(None, arithmetic)  # constants, rounded like everything else
            return batch.apply(name, *operands)

        function.__name__ = name
        return function

    module = types.SimpleNamespace(**{k: v for k, v in vars(math).items() if not callable(v)})
    found: dict[Any, Any] = {math: module}
    for name, numpy_name in NAMES.items():
        function = twin(numpy_name)
        setattr(module, name, function)
        found[getattr(math, name)] = function
    module.erf, module.erfc = twin("erf"), twin("erfc")
    found[math.erf], found[math.erfc] = module.erf, module.erfc
    own = _words(arithmetic) if arithmetic.name == "float64" else _stand_ins(module)
    return {**found, **own}


def chosen(order: str) -> Callable[..., Any]:
    """`max` or `min` of numbers point by point, as Python has it, without dividing the points."""
    plain = max if order == "gt" else min

    def function(*operands: Any, **options: Any) -> Any:
        batch = next((o for o in operands if isinstance(o, Batch)), None)
        if batch is None:
            return plain(*operands, **options)
        best = batch.apply("positive", operands[0])
        for other in operands[1:]:
            other = batch.apply("positive", other)
            better = getattr(other, f"__{order}__")(best).values
            best = Batch(np.where(better, other.values, best.values), batch.arithmetic)
        return best

    return function


class Rebound(Specialiser):
    """Binds everything a function reaches to one type: tables, and `max` and `min` too."""

    def __init__(self, arithmetic: Arithmetic) -> None:
        super().__init__(lambda function: function, twins(arithmetic))
        self._arithmetic = arithmetic

    def clone(self, function: Callable[..., Any], bound: Mapping[str, Any]) -> types.FunctionType:
        """`function` with every global name it uses replaced by its counterpart."""
        made, one = super().clone(function, bound), self._arithmetic
        made.__globals__.setdefault("max", chosen("gt"))
        made.__globals__.setdefault("min", chosen("lt"))
        for name, value in made.__globals__.items():
            if isinstance(value, np.ndarray) and value.dtype == np.float64 != one.dtype:
                made.__globals__[name] = Table(one.array(value), one)
        return made


def _words(arithmetic: Arithmetic) -> dict[Any, Any]:
    """Doubles as words and back, on arrays."""

    def word_of(x: object) -> Any:
        values = np.asarray(x.values if isinstance(x, Batch) else x, dtype=np.float64)
        return Whole(values.view(np.int64), arithmetic)

    def double_of(word: object) -> Any:
        return Batch(np.asarray(getattr(word, "values", word)).view(np.float64), arithmetic)

    def number_of(word: object) -> Any:
        return Batch(np.asarray(getattr(word, "values", word), dtype=np.float64), arithmetic)

    return {bits.word_of: word_of, bits.double_of: double_of, bits.number_of: number_of}


def _stand_ins(m: types.SimpleNamespace) -> dict[Any, Any]:
    """What stands for each polynomial of `special`."""

    def cosine_power(d: Any, n: Any) -> Any:
        y = m.exp(n * m.log1p(-d))
        return 0.0 if d >= 1.0 else y

    by_name: Mapping[str, Callable[..., Any]] = {
        "cosine_power": cosine_power,
        "exp": m.exp,
        "exp2": m.exp2,
        "expm1": m.expm1,
        "log": m.log,
        "log2": m.log2,
        "log1p": m.log1p,
        "log2_1p": lambda y: m.log1p(y) * (1.0 / math.log(2.0)),
        "sin_half_turn": lambda t: m.sin(math.pi * t),
        "cos_half_turn": lambda t: m.cos(math.pi * t),
        "turn": lambda u: (m.cos(m.tau * (u - 0.5)), m.sin(m.tau * (u - 0.5))),
        "asin_low": m.asin,
    }
    return {getattr(special, k): v for k, v in by_name.items() if hasattr(special, k)}
