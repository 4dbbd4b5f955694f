"""The name of a kernel changes with everything its machine code depends on, and nothing else."""
from __future__ import annotations

import itertools
import types
from typing import Any

import numpy as np
import pytest

from montecarlo_brdf.compile.cache import Fingerprint

BASE = """
import math
import numpy as np
TABLE = np.array([1.0, 2.0])
C = 0.5
PAIR = (1, (2.0, 3))
def helper(x):
    return x + 1.0
def outer(c):
    def inner(x):
        return c * x
    return inner
closed = outer(2.0)
def f(x, y=3.0):
    return math.sqrt(x) * C + helper(y) + TABLE[0] + closed(x) + PAIR[0] + module.g(x)
"""
HELPER_MODULE = """
K = 1.0
def h(x):
    return x * K
def g(x):
    return h(x)
def unused(x):
    return x
"""
#: What changes, by replacing text in the user's file or in the module that it imports.
CHANGES = {
    "code": ("* C +", "- C +"),
    "constant in code": ("x + 1.0", "x + 1.5"),
    "type of a constant": ("x + 1.0", "x + 1"),
    "global number": ("C = 0.5", "C = 0.25"),
    "type of a global": ("C = 0.5", "C = True"),
    "nested tuple": ("(2.0, 3)", "(2.0, 4)"),
    "array value": ("[1.0, 2.0]", "[1.0, 2.5]"),
    "array type": ("[1.0, 2.0]", "[1, 2]"),
    "array shape": ("[1.0, 2.0]", "[[1.0, 2.0]]"),
    "default": ("y=3.0", "y=4.0"),
    "closure cell": ("outer(2.0)", "outer(2.5)"),
    "function of the standard library": ("math.sqrt", "math.exp"),
    "helper's name": ("helper(y)", "closed(y)"),
    "module's function": ("return h(x)", "return h(x) + 1.0"),
    "function behind a module's function": ("x * K", "x / K"),
    "module's number": ("K = 1.0", "K = 2.0"),
}


def function(old: str = "", new: str = "") -> Any:
    """f of BASE, with a change."""
    module = types.ModuleType("users_helpers")
    exec(HELPER_MODULE.replace(old, new) if old else HELPER_MODULE, module.__dict__)
    scope: dict[str, Any] = {"module": module, "__name__": "users_model"}
    exec(BASE.replace(old, new) if old else BASE, scope)
    return scope["f"]


def name(value: Any) -> str:
    content = Fingerprint()
    content.add(value)
    return content.hexdigest()


def test_equal_content_has_equal_names() -> None:
    assert name(function()) == name(function())


@pytest.mark.parametrize("change", CHANGES)
def test_every_change_changes_the_name(change: str) -> None:
    old, new = CHANGES[change]
    assert old in BASE + HELPER_MODULE
    assert name(function(old, new)) != name(function())


def test_what_is_not_used_does_not_count() -> None:
    assert name(function("def unused(x):\n    return x", "")) == name(function())


def test_values_that_look_alike_have_different_names() -> None:
    numbers = [0, 0.0, -0.0, False, "0", None, "", b"", float("nan"), 1e-320]
    containers = [(), [], {}, set(), (0,), [0], {0}, (0, 0), {0: 0}, [(0, 0)]]
    arrays = [np.zeros(1), np.zeros(1, np.float32), np.zeros((1, 1)), np.ones(1)]
    values = [*numbers, *containers, *arrays]
    for a, b in itertools.combinations(values, 2):
        assert name(a) != name(b), (a, b)


def test_sets_and_dictionaries_have_no_order() -> None:
    words = [f"word{i}" for i in range(50)]
    assert name(set(words)) == name(set(words[25:] + words[:25]))
    assert name(dict.fromkeys(words, 1)) == name(dict.fromkeys(reversed(words), 1))


def test_mutual_recursion_ends() -> None:
    scope: dict[str, Any] = {}
    exec("def a(x): return b(x) if x else 0\ndef b(x): return a(x - 1)", scope)
    assert name(scope["a"]) != name(scope["b"])


def test_functions_with_exchanged_roles_differ() -> None:
    """Not only which functions are reached but which name stands for which."""
    text = "def a(x): return x\ndef b(x): return -x\ndef f(x): return {}(x) - 2 * {}(x)"
    one: dict[str, Any] = {}
    two: dict[str, Any] = {}
    exec(text.format("a", "b"), one)
    exec("def b(x): return x\ndef a(x): return -x\ndef f(x): return a(x) - 2 * b(x)", two)
    assert name(one["f"]) != name(two["f"])
