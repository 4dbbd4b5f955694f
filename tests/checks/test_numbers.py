"""Every number that decides stands in docs/statistics.md with its value and what it is."""

from __future__ import annotations

import ast
import importlib
import math
from collections.abc import Iterator
from numbers import Number
from pathlib import Path

import pytest

import montecarlo_brdf

PACKAGE = Path(montecarlo_brdf.__file__).parent
TABLE = PACKAGE.parent / "docs" / "statistics.md"
FOLDERS = ("checks", "cases", "judge", "stability", "table", "verify")
ESTIMATE = (
    "adaptive", "ascent", "density", "ends", "mesh", "pieces", "plan", "polynomials", "quadrature",
    "roots", "tangents", "trust",
)  # fmt: skip
OTHERS = ("arithmetic/batch", "arithmetic/types", "sampling/slopes", "statistics")
FILES = (*OTHERS, *(f"estimate/{name}" for name in ESTIMATE))
HINTS = {"checks/_hints", "judge/hint", "verify/bench", "verify/failure"}  # decide nothing
#: where numbers stand in a kernel's rows
PLACES = {
    "AT", "STOP", "NEXT", "TAKEN", "SIZES", "TABLE", "COLUMNS", "FEWEST", "HOPELESS", "STEEPEST",
    "FACTORS",
}  # fmt: skip
KNOWN = {"math": math, "map": map, "range": range, "tuple": tuple}
KINDS = {"tolerance", "budget", "derived", "tuned and left"}


def files() -> Iterator[str]:
    """checks/pdf and so on."""
    for path in sorted(p for folder in FOLDERS for p in (PACKAGE / folder).glob("*.py")):
        name = path.relative_to(PACKAGE).with_suffix("").as_posix()
        if name not in HINTS:
            yield name
    yield from FILES


def numeric(value: object) -> bool:
    """Whether a value is a number or is made of some."""
    if isinstance(value, dict):
        return any(map(numeric, value.values()))
    if isinstance(value, tuple):
        return any(map(numeric, value))
    return isinstance(value, Number) and not isinstance(value, bool)


def constants(file: str) -> dict[str, object]:
    """Names that a file gives to numbers, outside its functions and classes."""
    module = importlib.import_module(f"montecarlo_brdf.{file.replace('/', '.')}")
    found = {}
    for node in ast.parse((PACKAGE / f"{file}.py").read_text(encoding="utf-8")).body:
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        for name in (n.id for t in targets if t for n in ast.walk(t) if isinstance(n, ast.Name)):
            value = getattr(module, name, None)
            if numeric(value) and not (file == "estimate/ascent" and name in PLACES):
                found[name] = value
    return found


def listed() -> Iterator[tuple[str, str, str, str, str]]:
    """Rows of the table."""
    text = TABLE.read_text(encoding="utf-8").partition("## Numbers that decide")[2]
    for line in text.partition("\n## ")[0].splitlines():
        if line.startswith("|") and not line.startswith(("|--", "| name")):
            name, file, value, kind, why = (c.strip() for c in line.strip("|").split(" | "))
            yield name, file, value.strip("`"), kind, why


@pytest.mark.parametrize("row", list(listed()), ids=lambda row: f"{row[1]}:{row[0]}")
def test_a_listed_number_exists_with_its_value(row: tuple[str, str, str, str, str]) -> None:
    name, file, value, kind, why = row
    expected = eval(value, {"__builtins__": {}, **KNOWN})
    assert constants(file)[name] == expected
    assert kind in KINDS and why


@pytest.mark.parametrize("file", list(files()))
def test_no_number_is_missing(file: str) -> None:
    assert set(constants(file)) == {name for name, where, *_ in listed() if where == file}
