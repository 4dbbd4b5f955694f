"""Formulas of parameters that a description has, as source of Python: `lobe`, `albedo`.

They run in plain Python and are written by whoever wrote the shader, but no text of a shader may
reach Python by itself: only numbers, parameters and functions of mathematics pass.
"""

from __future__ import annotations

import ast
from collections.abc import Collection

from montecarlo_brdf.foreign.complaint import Complaint

PLAIN = (ast.Expression, ast.BinOp, ast.UnaryOp, ast.Constant, ast.Name, ast.Load, ast.Call,
         ast.operator, ast.unaryop)  # fmt: skip
FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "acos", "asin", "atan", "pow", "pi")


def source(text: str, parameters: Collection[str], others: Collection[str] = ()) -> str:
    """The formula with `p.` before parameters and `math.` before functions."""
    try:
        tree = ast.parse(text.replace("^", "**").strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError):
        raise Complaint(f"{text!r} is no formula") from None
    for node in ast.walk(tree):
        _refuse(node, {*parameters, *others, *FUNCTIONS})
    renamed = _Renamed({n: f"p.{n}" for n in parameters} | {n: f"math.{n}" for n in FUNCTIONS})
    return ast.unparse(renamed.visit(tree))


def _refuse(node: ast.AST, known: Collection[str]) -> None:
    if isinstance(node, ast.Name) and node.id not in known:
        raise Complaint(f"{node.id} is neither a parameter nor one of {', '.join(FUNCTIONS)}")
    number = not isinstance(node, ast.Constant) or type(node.value) in (int, float)
    if not isinstance(node, PLAIN) or not number:
        raise Complaint(f"write numbers, parameters and {', '.join(FUNCTIONS)}")
    if isinstance(node, ast.Call) and not (isinstance(node.func, ast.Name) and not node.keywords):
        raise Complaint("call functions by their names")


class _Renamed(ast.NodeTransformer):
    """Names as what they are of."""

    def __init__(self, names: dict[str, str]) -> None:
        self.names = names

    def visit_Name(self, node: ast.Name) -> ast.Name:  # noqa: N802
        return ast.Name(self.names.get(node.id, node.id), node.ctx)


