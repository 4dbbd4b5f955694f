"""Bind a model's functions into a kernel template.

A kernel is a plain Python function whose global names stand for other functions. A `Specialiser`
clones it with those names bound, compiling everything it reaches (plain functions, functions of
the user's own modules, functions that were already jitted) with our options.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Mapping
from typing import Any

from montecarlo_brdf.compile.reach import (
    Function,
    is_own_module,
    module_functions,
    names_used,
    plain,
    references,
    shares,
)


class Specialiser:
    """Compiles a function and everything it reaches, each once."""

    def __init__(self, compile: Callable[[Function], Any], twins: Mapping[Any, Any]):
        self._compile = compile
        self._done: dict[int, Any] = {}
        self._bound: dict[tuple[Any, ...], Any] = {}
        self._modules: dict[tuple[int, int], types.ModuleType] = {}
        self._twins = {id(f): twin for f, twin in twins.items()}
        self._alive: list[Any] = list(twins)

    def bind(self, function: Function, bound: Mapping[str, Any]) -> Any:
        """`function`, and what it shares names with, compiled with the names in `bound` standing
        for the functions given."""
        key = (id(function), *sorted((name, id(value)) for name, value in bound.items()))
        if key not in self._bound:
            self._alive += [function, *bound.values()]
            self._bound[key] = self.compiled(self.clone(function, bound))
        return self._bound[key]

    def compiled(self, clone: Function) -> Any:
        """A clone compiled, for others to call as it is."""
        compiled = self._compile(clone)
        self._twins[id(compiled)] = compiled
        return compiled

    def clone(self, function: Function, bound: Mapping[str, Any]) -> types.FunctionType:
        """`function` with every global name it uses replaced by its compiled counterpart."""
        scope: dict[str, Any] = {"__builtins__": __builtins__, "__name__": function.__module__}
        for name, value in references(function, bound).items():
            beside = shares(function, value, bound)
            scope[name] = (
                self.bind(value, bound) if beside else self._counterpart(value, function.__code__)
            )
        cells = tuple(
            types.CellType(self._counterpart(c.cell_contents, function.__code__))
            for c in function.__closure__ or ()
        )
        clone = types.FunctionType(
            function.__code__, scope, function.__name__, function.__defaults__, cells or None
        )
        clone.__qualname__ = function.__qualname__
        return clone

    def _counterpart(self, value: Any, code: types.CodeType) -> Any:
        if id(value) in self._twins:
            return self._twins[id(value)]
        value = plain(value)
        if isinstance(value, types.FunctionType):
            return self._function(value)
        if is_own_module(value):
            return self._module(value, code)
        return contiguous(value)

    def _function(self, function: types.FunctionType) -> Any:
        if id(function) not in self._done:
            self._alive.append(function)
            self._done[id(function)] = self._compile(self.clone(function, {}))
        return self._done[id(function)]

    def _module(self, module: types.ModuleType, code: types.CodeType) -> types.ModuleType:
        key = (id(module), id(code))
        if key not in self._modules:
            self._alive += [module, code]
            stand_in = self._modules[key] = types.ModuleType(module.__name__)  # before its members:
            for name, value in module_functions(
                module, names_used(code)
            ).items():  # they may use it
                setattr(stand_in, name, self._counterpart(value, code))
        return self._modules[key]


def contiguous(value: Any) -> Any:
    """Tables as compiled code stores them: numba would keep the address of one with gaps."""
    if isinstance(value, tuple):
        items = [contiguous(item) for item in value]
        same = all(new is old for new, old in zip(items, value, strict=True))
        return value if same else _tuple_like(value, items)
    flags = getattr(value, "flags", None)
    if getattr(flags, "forc", True):
        return value
    return value.copy(order="C")


def _tuple_like(value: Any, items: list[Any]) -> Any:
    return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
