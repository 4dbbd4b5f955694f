"""Bind a model's functions into a kernel template, and name the result by its content.

A kernel is a plain Python function whose global names stand for other functions. `specialised`
clones it with those names bound, compiling everything it reaches (plain functions, functions of
the user's own modules, functions that were already jitted) with our options. `fingerprint` hashes
all that this depends on, code, constants, arrays, defaults and closure cells of every function
reached, so a cached kernel can never be stale.
"""

from __future__ import annotations

import dis
import enum
import functools
import hashlib
import os
import types
from collections.abc import Callable, Iterator, Mapping
from typing import Any

Function = Callable[..., Any]
STANDARD = ("math", "cmath", "builtins", "numpy", "numba")
#: Values whose repr is all there is to know about them.
PLAIN = (int, float, complex, str, bytes, type(None), type(...), slice, range)
PLAIN_MODULES = ("numpy", "numba.core.types")
GLOBAL_LOADS = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")
_PROCESS = os.urandom(16)
_unknown: dict[int, Any] = {}


def plain(value: Any) -> Any:
    """The Python function behind a numba dispatcher; anything else as it is."""
    return getattr(value, "py_func", value)


def is_own_module(value: Any) -> bool:
    """A module whose functions must be compiled with the kernel (not math, not numpy)."""
    return isinstance(value, types.ModuleType) and value.__name__.split(".")[0] not in STANDARD


def names_used(code: types.CodeType) -> Iterator[str]:
    """Global and attribute names in a code object and those nested in it, in a fixed order."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from names_used(constant)


@functools.lru_cache(maxsize=4096)
def globals_used(code: types.CodeType) -> tuple[str, ...]:
    """Names that a code object and those nested in it look up among their globals.

    Attributes are not among them: `p.albedo` has nothing to do with a function `albedo`.
    """
    found = {i.argval for i in dis.get_instructions(code) if i.opname in GLOBAL_LOADS}
    nested = (c for c in code.co_consts if isinstance(c, types.CodeType))
    return tuple(sorted(found.union(*map(globals_used, nested))))


def references(function: Function, bound: Mapping[str, Any]) -> dict[str, Any]:
    """The global names that `function` uses and what each stands for, `bound` first."""
    found = {}
    for name in globals_used(function.__code__):
        if name in bound:
            found[name] = bound[name]
        elif name in function.__globals__:
            found[name] = function.__globals__[name]
    return found


def module_functions(module: types.ModuleType, names: Iterator[str]) -> dict[str, Any]:
    """The members of a user's own module that `names` mention."""
    return {n: getattr(module, n) for n in sorted(set(names)) if hasattr(module, n)}


class Fingerprint:
    """Content hash of values and of all the code that a function reaches."""

    def __init__(self) -> None:
        self._hash = hashlib.blake2b(digest_size=16)
        self._seen: dict[int, int] = {}
        self._modules: set[tuple[int, int]] = set()  # (module, code that uses it)

    def hexdigest(self) -> str:
        return self._hash.hexdigest()

    def add(self, value: Any, bound: Mapping[str, Any] | None = None) -> None:
        """Take in any value: code is followed, containers are walked, the rest goes by repr."""
        value = plain(value)
        if isinstance(value, types.FunctionType):
            self._add_function(value, bound or {})
        elif isinstance(value, types.CodeType):
            self._add_code(value)
        elif isinstance(value, (tuple, list)):
            self._add_sequence(value)
        elif isinstance(value, (set, frozenset)):
            self._text("set")
            self._add_sequence(sorted(value, key=repr))
        elif isinstance(value, dict):
            self._text("dictionary")
            self._add_sequence(sorted(value.items(), key=repr))
        elif hasattr(value, "tobytes") and hasattr(value, "dtype"):
            self._text(f"array {value.dtype} {value.shape}")
            self._hash.update(value.tobytes())
        elif isinstance(value, types.ModuleType):
            self._text(f"module {value.__name__}")
        elif isinstance(value, type):
            self._add_class(value)
        elif isinstance(value, types.BuiltinFunctionType):
            self._text(f"builtin {value.__module__}.{value.__qualname__}")
        elif isinstance(value, PLAIN) or type(value).__module__.startswith(PLAIN_MODULES):
            self._text(f"{type(value).__name__} {value!r}")
        else:
            self._add_unknown(value)

    def _text(self, text: str) -> None:
        self._hash.update(f"{len(text)}:{text};".encode())

    def _add_unknown(self, value: Any) -> None:
        """No content that could be hashed: the same kernel in this process, never in another."""
        _unknown[id(value)] = value  # kept alive, so that the id stays its own
        self._hash.update(_PROCESS)
        self._text(f"object {id(value)}")

    def _add_class(self, kind: type) -> None:
        """Names, fields and values of named tuples and enumerations, which kernels may use."""
        self._text(f"class {kind.__module__}.{kind.__qualname__}")
        if isinstance(kind, enum.EnumMeta):
            members: Mapping[str, Any] = kind.__members__
            self.add([(name, member.value) for name, member in members.items()])
        elif hasattr(kind, "_fields"):
            self.add((kind._fields, getattr(kind, "_field_defaults", {})))
        elif kind.__module__ != "builtins" and not kind.__module__.startswith(PLAIN_MODULES):
            self._add_unknown(kind)

    def _add_sequence(self, values: Any) -> None:
        self._text(f"{type(values).__name__} of {len(values)}")
        if hasattr(values, "_fields"):
            self._add_class(type(values))
        for value in values:
            self.add(value)

    def _add_code(self, code: types.CodeType) -> None:
        self._text(code.co_name)
        self._hash.update(code.co_code + code.co_exceptiontable)
        self.add(code.co_consts)
        self.add(code.co_names)
        self.add(code.co_varnames + code.co_freevars + code.co_cellvars)

    def _add_function(self, function: types.FunctionType, bound: Mapping[str, Any]) -> None:
        if id(function) in self._seen:
            self._text(f"function {self._seen[id(function)]} again")
            return
        self._seen[id(function)] = len(self._seen)
        self._add_code(function.__code__)
        self.add((function.__defaults__, function.__kwdefaults__))
        self.add([cell.cell_contents for cell in function.__closure__ or ()])
        for name, value in references(function, bound).items():
            self._text(name)
            self.add(value)
            self._add_module(value, function.__code__)

    def _add_module(self, module: Any, code: types.CodeType) -> None:
        """What `code` may use of a user's module, and of the modules in it."""
        if not is_own_module(module) or (id(module), id(code)) in self._modules:
            return
        self._modules.add((id(module), id(code)))
        for name, value in module_functions(module, names_used(code)).items():
            self._text(name)
            self.add(value)
            self._add_module(value, code)


class Specialiser:
    """Compiles a function and everything it reaches, each once."""

    def __init__(self, compile: Callable[[Function], Any], twins: Mapping[Any, Any]):
        self._compile = compile
        self._done: dict[int, Any] = {}
        self._modules: dict[tuple[int, int], types.ModuleType] = {}
        self._twins = {id(f): twin for f, twin in twins.items()}
        self._alive: list[Any] = list(twins)

    def bind(self, function: Function, bound: Mapping[str, Any]) -> Any:
        """`function` compiled with the names in `bound` standing for the functions given."""
        return self.compiled(self.clone(function, bound))

    def compiled(self, clone: Function) -> Any:
        """A clone compiled, for others to call as it is."""
        compiled = self._compile(clone)
        self._twins[id(compiled)] = compiled
        return compiled

    def clone(self, function: Function, bound: Mapping[str, Any]) -> types.FunctionType:
        """`function` with every global name it uses replaced by its compiled counterpart."""
        scope: dict[str, Any] = {"__builtins__": __builtins__, "__name__": function.__module__}
        for name, value in references(function, bound).items():
            scope[name] = self._counterpart(value, function.__code__)
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
        return value

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
