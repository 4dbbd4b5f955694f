"""What the author of a scene expects L_o to be: a number, or a formula of the viewer's angles and
of the surface's parameters, as "albedo * cos(theta_o)". Formulas are read, never executed."""

from __future__ import annotations

import ast
import functools
import math
import operator
from collections.abc import Callable, Mapping
from typing import NamedTuple

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.model import Model, ParameterSet

TOLERANCE = 1e-4  # relative, if nothing is said
LONGEST = 1000  # characters of a formula
FUNCTIONS: dict[str, Callable[..., float]] = {
    name: getattr(math, name)
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2")
}  # fmt: skip
FUNCTIONS |= {"min": min, "max": max, "abs": abs}
OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv, ast.Pow: math.pow, ast.USub: operator.neg, ast.UAdd: operator.pos,
}  # fmt: skip
#: what every formula may use: angles in radians, the cosine of theta_o
ANGLES = ("theta_o", "phi_o", "mu_o")

Values = Mapping[str, float]


class Expected(NamedTuple):
    """One formula per channel, or one for all; how far L_o may be from it."""

    formulas: tuple[str, ...]
    relative: float = TOLERANCE
    absolute: float = 0.0

    def value(self, channel: int, theta_o_deg: float, phi_o_deg: float, more: Values) -> float:
        """What a channel is at a view. Raises UserError for a name that nothing stands for."""
        theta, phi = math.radians(theta_o_deg), math.radians(phi_o_deg)
        angles = {"theta_o": theta, "phi_o": phi, "mu_o": math.cos(theta), "pi": math.pi}
        formula = self.formulas[channel if len(self.formulas) > 1 else 0]
        return evaluated(formula, {**more, **angles})

    def tolerance(self, value: float) -> float:
        """The deviation that is allowed."""
        return max(self.absolute, self.relative * abs(value))


def named_values(model: Model, p: ParameterSet, channel: int) -> dict[str, float]:
    """The parameters of a model, in one channel, by the names that formulas use."""
    values = {model.labels.get(n, n): getattr(p, n) for n in model.Params._fields}
    return {
        n: float(v[channel if channel < len(v) else 0] if isinstance(v, tuple) else v)
        for n, v in values.items()
    }


def evaluated(formula: str, names: Values) -> float:
    """The value of a formula. Raises UserError for what is no formula, or has no finite value."""
    try:
        value = _value(_tree(formula).body, names)
    except (ArithmeticError, ValueError, TypeError, RecursionError) as error:
        raise UserError(f"{formula!r} has no value: {error}") from error
    if not math.isfinite(value):
        raise UserError(f"{formula!r} has no finite value")
    return value


@functools.lru_cache(maxsize=64)
def _tree(formula: str) -> ast.Expression:
    if len(formula) > LONGEST:
        raise UserError(f"a formula has at most {LONGEST} characters")
    try:
        return ast.parse(formula.strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        raise UserError(f"{formula!r} is no formula") from error


def _value(node: ast.expr, names: Values) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    if isinstance(node, ast.Name):
        if node.id not in names:
            raise UserError(unknown("quantity", node.id, names))
        return names[node.id]
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        sides = (_value(side, names) for side in (node.left, node.right))
        return float(OPERATORS[type(node.op)](*sides))
    if isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
        return float(OPERATORS[type(node.op)](_value(node.operand, names)))
    return _called(node, names)


def _called(node: ast.expr, names: Values) -> float:
    if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name)) or node.keywords:
        allowed = "numbers, names, + - * / ** and ()"
        raise UserError(f"a formula has no {ast.unparse(node)!r}, only {allowed}")
    if node.func.id not in FUNCTIONS:
        raise UserError(unknown("function", node.func.id, FUNCTIONS))
    return float(FUNCTIONS[node.func.id](*(_value(a, names) for a in node.args)))
