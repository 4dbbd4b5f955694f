"""Formulas of the coordinates of a table, as people type them: 'roughness^2', 'max(r, 0.01)'."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from types import SimpleNamespace
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.foreign import formula
from montecarlo_brdf.foreign.complaint import Complaint

#: what shaders have besides the functions of a description
OTHERS: dict[str, Callable[..., Any]] = {
    "min": min, "max": max, "abs": abs, "exp2": math.exp2,
}  # fmt: skip
Formula = Callable[[Mapping[str, float]], float]


def formula_of(text: str, names: Collection[str]) -> Formula:
    """A function of named numbers. Raises UserError for what is no formula of them."""
    try:
        source = formula.source(text, names, OTHERS)
    except Complaint as error:
        raise UserError(f"formula {text!r}: {error}") from None
    code = compile(source, "formula", "eval")
    scope = {"__builtins__": {}, "math": math, **OTHERS}

    def value(given: Mapping[str, float]) -> float:
        try:
            return float(eval(code, {**scope, "p": SimpleNamespace(**given)}))  # noqa: S307
        except (ArithmeticError, ValueError, TypeError) as error:
            where = ", ".join(f"{k} = {v:g}" for k, v in given.items())
            raise UserError(f"formula {text!r} has no value at {where}: {error}") from None

    return value
