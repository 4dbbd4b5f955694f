"""Expressions of any form mean in a translated shader what they mean to NumPy."""
from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
import stored
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from montecarlo_brdf.foreign import glslang
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.python import Source
from montecarlo_brdf.foreign.widen import widened

pytestmark = stored.needs_wheel
NAMES = ("x", "y", "z")
LITERALS = ("0.5", "1.0", "2.0", "0.1", "3.25")
#: GLSL's name -> NumPy's function
UNARY = {
    "sin": np.sin, "cos": np.cos, "abs": np.abs, "exp": np.exp, "floor": np.floor, "ceil": np.ceil,
    "fract": lambda a: a - np.floor(a), "sign": np.sign, "trunc": np.trunc, "atan": np.arctan,
    "tanh": np.tanh, "-": np.negative,
}  # fmt: skip
BINARY = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "min": np.minimum,
    "max": np.maximum, "step": lambda a, b: np.where(b < a, 0.0, 1.0), "atan": np.arctan2,
}  # fmt: skip
TERNARY = {
    "clamp": lambda a, b, c: np.minimum(np.maximum(a, b), c),
    "mix": lambda a, b, c: a * (1.0 - c) + b * c,
    "?": lambda a, b, c: np.where(a < b, c, b - c),
}
Tree = tuple[Any, ...]
#: a compiler folds what has no variable in it, in single precision
SCALED = st.tuples(st.just("*"), st.sampled_from(NAMES), st.sampled_from(LITERALS))
LEAVES = st.sampled_from(NAMES).map(lambda name: (name,)) | SCALED.map(
    lambda parts: (parts[0], (parts[1],), (parts[2],))
)
#: what steps: an optimiser rounds otherwise, and may step elsewhere
STEPS = {"floor", "ceil", "fract", "sign", "trunc", "step", "?"}


def steps(tree: Tree) -> bool:
    return tree[0] in STEPS or any(steps(part) for part in tree[1:])


def nodes(inner: st.SearchStrategy[Tree]) -> st.SearchStrategy[Tree]:
    one = st.tuples(st.sampled_from(sorted(UNARY)), inner)
    two = st.tuples(st.sampled_from(sorted(BINARY)), inner, inner)
    return one | two | st.tuples(st.sampled_from(sorted(TERNARY)), inner, inner, inner)


TREES = st.recursive(LEAVES, nodes, max_leaves=12)


def glsl(tree: Tree) -> str:
    name, parts = tree[0], [glsl(part) for part in tree[1:]]
    if not parts:
        return str(name)
    if name == "?":
        return f"({parts[0]} < {parts[1]} ? {parts[2]} : {parts[1]} - {parts[2]})"
    if name in ("+", "*", "/") or (name == "-" and len(parts) == 2):
        return f"({parts[0]} {name} {parts[1]})"
    return f"(-{parts[0]})" if name == "-" else f"{name}({', '.join(parts)})"


def value(tree: Tree, names: dict[str, float]) -> Any:
    name, parts = tree[0], [value(part, names) for part in tree[1:]]
    if not parts:
        return np.float64(names.get(name, 0.0) if name in NAMES else name)
    return {1: UNARY, 2: BINARY, 3: TERNARY}[len(parts)][name](*parts)


def translated(tree: Tree, optimise: bool) -> Any:
    """The function that a shader with this expression becomes."""
    binary, told = glslang.spirv(
        "#version 450\nlayout(std430, binding = 0) buffer B { float bc[]; };\nvoid main() {\n"
        "float x = bc[0], y = bc[1], z = bc[2];\n" f"bc[3] = {glsl(tree)};\n}}\n", "x.glsl"
    )  # fmt: skip
    assert binary, told
    wide = widened(binary, {})
    source = Source(glslang.optimised(wide) if optimise else wide, "shader", Numerals(single=False))
    text = f"from montecarlo_brdf.foreign.runtime import *\n{source.text}"
    return stored.functions(text)["shader"], source.arguments


@pytest.mark.parametrize("optimise", [False, True])
@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(tree=TREES, point=st.tuples(*[st.floats(-3.0, 3.0, width=32)] * 3))
def test_any_expression(optimise: bool, tree: Tree, point: tuple[float, float, float]) -> None:
    assume(not (optimise and steps(tree)))
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        due = float(value(tree, dict(zip(NAMES, point, strict=True))))
    function, arguments = translated(tree, optimise)
    try:
        (found,) = function(*(point[k] for k in arguments))
    except (ZeroDivisionError, OverflowError, ValueError):
        return  # Python raises what compiled arithmetic calls infinite, or no number
    if np.isfinite(due):
        assert found == pytest.approx(due, rel=1e-9, abs=1e-9)
