"""Templates, and what becomes of them: functions in which some names stand for other things.

A template is a plain Python function of ours whose capitalised global names are holes. `bound` says
what fills them: functions, numbers, other bound templates, instructions. A `Specialiser` makes
clones with the holes filled, compiling everything they reach (plain functions, functions of the
user's own modules, functions that were already jitted) with our options, each once.
"""

from __future__ import annotations

import dis
import functools
import types
from collections.abc import Callable, Iterator, Mapping, MutableSequence, Sequence
from typing import Any, NamedTuple, TypeGuard

Function = Callable[..., Any]
#: What a template sees of the three rows that a kernel is called with; `ints` it may use as places
#: to count in.
Ints = MutableSequence[int]
Reals = Sequence[float]
Out = MutableSequence[float]
STANDARD = ("math", "cmath", "builtins", "numpy", "numba")
STRICT = "STRICT"
GLOBAL_LOADS = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")


class Called(NamedTuple):
    """A function of a model where a template calls it: with `vectors` triples of numbers and the
    parameters, which the template itself never looks at."""

    function: Function
    vectors: int = 2


def plain(value: object) -> Any:
    """The Python function behind a numba dispatcher or a call; anything else as it is."""
    value = value.function if isinstance(value, Called) else value
    return getattr(value, "py_func", value)


def is_strict(function: Function) -> bool:
    """Whether every operation is to be rounded as it is written: its module says STRICT = True.

    Elsewhere sums may be reordered and products fused, which is faster and no less precise; but it
    is not what is asked of a function whose rounding is looked at.
    """
    return plain(function).__globals__.get(STRICT) is True


def is_own_module(value: object) -> TypeGuard[types.ModuleType]:
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


class Hole:
    """What a name of a template is until something fills it."""


def hole() -> Any:
    """A name of a template that is to be bound."""
    return Hole()


def references(function: Function, names: Mapping[str, object]) -> dict[str, Any]:
    """The global names that `function` uses and what each stands for; `names` fill holes."""
    scope = function.__globals__
    used = [n for n in globals_used(function.__code__) if n in scope]
    return {n: names[n] if _fills(scope[n], n, names) else scope[n] for n in used}


def uses(value: object, names: Mapping[str, object]) -> TypeGuard[types.FunctionType]:
    """Whether `value` is a template with a hole that one of `names` fills."""
    if not isinstance(value, types.FunctionType) or not names:
        return False
    scope = value.__globals__
    return any(_fills(scope.get(n), n, names) for n in globals_used(value.__code__))


def _fills(value: object, name: str, names: Mapping[str, object]) -> bool:
    return isinstance(value, Hole) and name in names


@functools.lru_cache(maxsize=256)
def takes_more(function: Function | Called | None, place: int, count: int) -> bool:
    """Whether `function` may use more than the first `count` elements of the argument at `place`.

    Only the plainest use proves that it does not: `u[0]`, `u[1]` in its own code and no other.
    """
    if function is None:
        return False
    code = plain(function).__code__
    name = code.co_varnames[place]
    steps = list(dis.get_instructions(code))
    pairs = (s.argval if isinstance(s.argval, tuple) else (s.argval,) for s in steps)
    uses = [k for k, named in enumerate(pairs) if name in named]
    return name in code.co_cellvars or not all(
        steps[k].opname == "LOAD_FAST"
        and steps[k + 1].opname == "LOAD_CONST"
        and steps[k + 1].argval in range(count)
        and steps[k + 2].opname == "BINARY_SUBSCR"
        for k in uses
    )


def module_functions(module: types.ModuleType, names: Iterator[str]) -> dict[str, Any]:
    """The members of a user's own module that `names` mention."""
    return {n: getattr(module, n) for n in sorted(set(names)) if hasattr(module, n)}


class Bound(NamedTuple):
    """A template and what its holes are filled with, also in templates that fill holes of it."""

    function: Function
    names: frozenset[tuple[str, object]]


def bound(function: Function, **names: object) -> Bound:
    """`function` with names that stand for something."""
    return Bound(function, frozenset(names.items()))


class Instruction:
    """Something that only compiled code can do; equal ones do the same."""

    def key(self) -> object:
        """What it depends on, as plain data."""
        raise NotImplementedError

    def intrinsic(self) -> Any:
        """What numba calls."""
        raise NotImplementedError


class Specialiser:
    """Compiles a function and everything it reaches, each once."""

    def __init__(self, compile: Callable[[Function], Any], twins: Mapping[Any, Any]):
        self._compile = compile
        self._done: dict[int, Any] = {}
        self._bound: dict[Bound, Any] = {}
        self._instructions: dict[Instruction, Any] = {}
        self._modules: dict[tuple[int, int], types.ModuleType] = {}
        self._twins = {id(f): twin for f, twin in twins.items()}
        self._alive: list[Any] = list(twins)

    def bind(self, template: Bound) -> Any:
        """A template with its holes filled, compiled for others to call."""
        if template not in self._bound:
            made = self._compile(self.clone(template.function, dict(template.names)))
            self._bound[template] = self._twins[id(made)] = made
        return self._bound[template]

    def clone(self, function: Function, names: Mapping[str, object]) -> types.FunctionType:
        """`function` with every global name it uses replaced by its compiled counterpart."""
        code = function.__code__
        scope: dict[str, Any] = {"__builtins__": __builtins__, "__name__": function.__module__}
        scope[STRICT] = is_strict(function)
        for name, value in references(function, names).items():
            scope[name] = self._stand_in(value, code, names)
        cells = tuple(
            types.CellType(self._counterpart(c.cell_contents, code))
            for c in function.__closure__ or ()
        )
        clone = types.FunctionType(
            code, scope, function.__name__, function.__defaults__, cells or None
        )
        clone.__qualname__ = function.__qualname__
        clone.__module__ = None  # type: ignore[assignment]  # numba would import a user's file again
        return clone

    def _stand_in(self, value: object, code: types.CodeType, names: Mapping[str, object]) -> Any:
        if isinstance(value, Bound):
            return self.bind(value)
        if uses(value, names):
            return self.bind(Bound(value, frozenset(names.items())))
        if not isinstance(value, Instruction):
            return self._counterpart(value, code)
        if value not in self._instructions:
            self._instructions[value] = value.intrinsic()
        return self._instructions[value]

    def _counterpart(self, value: object, code: types.CodeType) -> Any:
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
            stand_in = self._modules[key] = types.ModuleType(module.__name__)
            members = module_functions(module, names_used(code))  # which may use the module itself
            for name, value in members.items():
                setattr(stand_in, name, self._counterpart(value, code))
        return self._modules[key]


def contiguous(value: Any) -> Any:
    """Tables as compiled code stores them: numba would keep the address of one with gaps."""
    if isinstance(value, tuple):
        items = [contiguous(item) for item in value]
        if all(new is old for new, old in zip(items, value, strict=True)):
            return value
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    flags = getattr(value, "flags", None)
    return value if getattr(flags, "forc", True) else value.copy(order="C")
