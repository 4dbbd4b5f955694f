"""What a model's own code says: the functions that it reaches, and the numbers in them."""

from __future__ import annotations

import math
import types
from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.compile.bind import (
    Function,
    is_own_module,
    module_functions,
    names_used,
    plain,
    references,
)
from montecarlo_brdf.model import Model

MOST = 48  # numbers
OF_TABLE = 24  # numbers of a table or tuple that count
SIZES = 1e-12, 1e9  # of numbers that may be compared with directions or parameters
PACKAGE = __name__.partition(".")[0]


def functions_of(model: Model) -> list[Function]:
    """What a model file defines and what these functions reach, once each; of ours, only models."""
    seen: dict[int, Function] = {}
    todo = [plain(f) for f in (model.f, model.sample, model.pdf, model.prepare, model.albedo) if f]
    while todo:
        function = todo.pop()
        if id(function) not in seen:
            seen[id(function)] = function
            todo += [v for v in _reached(function) if isinstance(v, types.FunctionType)]
    return [f for f in seen.values() if not _is_library(f)]


def _is_library(function: Function) -> bool:
    """Polynomials and other parts of ours below the models: their branches are tested by us."""
    first, *rest = str(function.__module__).split(".")
    return first == PACKAGE and rest[:1] != ["models"]


def _reached(function: Function) -> Iterator[Any]:
    """What the globals and cells of a function stand for, members of the user's modules too."""
    for value in (
        *references(function, {}).values(),
        *(cell.cell_contents for cell in function.__closure__ or ()),
    ):
        value = plain(value)
        if is_own_module(value):
            members = module_functions(value, names_used(function.__code__))
            yield from map(plain, members.values())
        else:
            yield value


def numbers_in(model: Model) -> list[float]:
    """The sizes of the numbers that the code holds, its constants first, then those of tables."""
    functions = functions_of(model)
    constants = [x for f in functions for x in _flat(f.__code__.co_consts)]
    tables = [x for f in functions for v in _reached(f) for x in _flat(v)]
    sizes = [abs(x) for x in constants + tables]
    return list(dict.fromkeys(x for x in sizes if SIZES[0] < x < SIZES[1]))[:MOST]


def _flat(value: Any) -> Iterator[float]:
    """The numbers in a value, some of a long one."""
    if isinstance(value, types.CodeType):
        yield from _flat(value.co_consts)
    elif isinstance(value, tuple | list):
        for item in value[:OF_TABLE]:
            yield from _flat(item)
    elif getattr(getattr(value, "dtype", None), "kind", "") in tuple("fi") and np.ndim(value):
        yield from map(float, value.flat[:OF_TABLE])
    elif isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        yield float(value)


def source_lines(function: Function) -> set[int]:
    """The numbers of the lines that a function runs, without the one of its `def`."""
    code = function.__code__
    lines = {line for _, _, line in code.co_lines() if line}
    return lines - {code.co_firstlineno}
