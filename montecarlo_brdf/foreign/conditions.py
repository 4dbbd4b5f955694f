"""Which lines of a shader its macros leave: as much of a preprocessor as `#include` needs.

A file may be included several times with other macros, or in a branch that is not taken. The
compiler has the last word: lines are only looked at here, and what cannot be evaluated counts as
taken.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

DIRECTIVE = re.compile(r"\s*#\s*(\w+)\s*(.*)", re.S)
COMMENT = re.compile(r"//.*|/\*.*?\*/", re.S)
DEFINED = re.compile(r"\bdefined\s*(?:\(\s*(\w+)\s*\)|(\w+))")
WORD = re.compile(r"[A-Za-z_]\w*")
SUFFIX = re.compile(r"\b(0[xX][0-9a-fA-F]+|\d+)[uUlL]+\b")
#: how often macros may stand for macros
DEEPEST = 16
OPERATIONS: dict[type, Callable[..., Any]] = {
    ast.Eq: operator.eq, ast.NotEq: operator.ne, ast.Lt: operator.lt, ast.LtE: operator.le,
    ast.Gt: operator.gt, ast.GtE: operator.ge, ast.Add: operator.add, ast.Sub: operator.sub,
    ast.Mult: operator.mul, ast.Mod: operator.mod, ast.FloorDiv: operator.floordiv,
    ast.BitAnd: operator.and_, ast.BitOr: operator.or_, ast.LShift: operator.lshift,
    ast.RShift: operator.rshift, ast.Not: operator.not_, ast.USub: operator.neg,
    ast.UAdd: operator.pos, ast.Invert: operator.invert,
}  # fmt: skip


class Conditions:
    """The macros that are known at a line, and the branches that it stands in."""

    def __init__(self, macros: Mapping[str, str]) -> None:
        self.macros = dict(macros)
        self._branches: list[tuple[bool, bool]] = []  # (is taken, one of it was)

    @property
    def live(self) -> bool:
        """Whether all branches around this line are taken."""
        return all(taken for taken, _ in self._branches)

    def heed(self, line: str) -> bool:
        """Take in a line; whether it is one of a branch's own."""
        match = DIRECTIVE.match(line)
        if not match:
            return False
        name, rest = match[1], COMMENT.sub(" ", match[2]).replace("\\\n", " ").strip()
        if name in ("if", "ifdef", "ifndef"):
            self._open(name, rest)
        elif name in ("elif", "else", "endif"):
            self._go_on(name, rest)
        else:
            if self.live:
                self._define(name, rest)
            return False
        return True

    def _open(self, name: str, rest: str) -> None:
        taken = self.live and self._holds(name, rest)
        self._branches.append((taken, taken or not self.live))

    def _go_on(self, name: str, rest: str) -> None:
        if not self._branches:
            return
        _, before = self._branches.pop()
        if name != "endif":
            taken = not before and (name == "else" or self._holds("if", rest))
            self._branches.append((taken, before or taken))

    def _define(self, name: str, rest: str) -> None:
        word = WORD.match(rest)
        if word and name == "define":
            self.macros[word[0]] = rest[word.end() :].strip()
        elif word and name == "undef":
            self.macros.pop(word[0], None)

    def _holds(self, name: str, rest: str) -> bool:
        if name != "if":
            known = (rest.split() or [""])[0] in self.macros
            return known == (name == "ifdef")
        text = DEFINED.sub(lambda m: str(int((m[1] or m[2]) in self.macros)), rest)
        for _ in range(DEEPEST):
            text = WORD.sub(lambda m: f"({self.macros.get(m[0]) or '0'})", SUFFIX.sub(r"\1", text))
            if not WORD.search(text):
                break
        text = re.sub(r"!(?!=)", " not ", text).replace("&&", " and ").replace("||", " or ")
        try:
            return bool(_value(ast.parse(text.replace("/", "//").strip(), mode="eval").body))
        except (SyntaxError, ValueError, TypeError, ArithmeticError, RecursionError, MemoryError):
            return True


def _value(node: ast.expr) -> Any:
    """The number that an expression of numbers is."""
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return node.value
    if isinstance(node, ast.BoolOp):
        values = [_value(v) for v in node.values]
        return any(values) if isinstance(node.op, ast.Or) else all(values)
    if isinstance(node, ast.UnaryOp):
        return OPERATIONS[type(node.op)](_value(node.operand))
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
        return OPERATIONS[type(node.op)](_value(node.left), _value(node.right))
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        return OPERATIONS[type(node.ops[0])](_value(node.left), _value(node.comparators[0]))
    raise ValueError(f"no number: {ast.dump(node)}")
