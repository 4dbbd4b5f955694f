"""What a function reaches: the globals, modules and arguments that its code uses."""

from __future__ import annotations

import dis
import functools
import types
from collections.abc import Callable, Iterator, Mapping
from typing import Any

Function = Callable[..., Any]
STANDARD = ("math", "cmath", "builtins", "numpy", "numba")
GLOBAL_LOADS = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")


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


def uses(value: object, names: Mapping[str, object]) -> bool:
    """Whether `value` is a template with a hole that one of `names` fills."""
    if not isinstance(value, types.FunctionType) or not names:
        return False
    scope = value.__globals__
    return any(_fills(scope.get(n), n, names) for n in globals_used(value.__code__))


def _fills(value: object, name: str, names: Mapping[str, object]) -> bool:
    return isinstance(value, Hole) and name in names


def takes_more(function: Function | None, place: int, count: int) -> bool:
    """Whether `function` may use more than the first `count` elements of the argument at `place`.

    Only the plainest use proves that it does not: `u[0]`, `u[1]` in its own code and no other.
    """
    if function is None:
        return False
    code = plain(function).__code__
    name = code.co_varnames[place]
    steps = list(dis.get_instructions(code))
    uses = [k for k, step in enumerate(steps) if mentions(step, name)]
    return name in code.co_cellvars or not all(
        steps[k].opname == "LOAD_FAST"
        and steps[k + 1].opname == "LOAD_CONST"
        and steps[k + 1].argval in range(count)
        and steps[k + 2].opname == "BINARY_SUBSCR"
        for k in uses
    )


def mentions(step: dis.Instruction, name: str) -> bool:
    """Whether an instruction has to do with a local name, alone or with another."""
    return name in step.argval if isinstance(step.argval, tuple) else step.argval == name


def module_functions(module: types.ModuleType, names: Iterator[str]) -> dict[str, Any]:
    """The members of a user's own module that `names` mention."""
    return {n: getattr(module, n) for n in sorted(set(names)) if hasattr(module, n)}
