"""Studies take hours, so that nobody notices when the package moves away under them: what each
script takes of it is there."""
from __future__ import annotations

import ast
import importlib
import types
from collections.abc import Iterator
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parent.parent / "scripts"


def taken(tree: ast.AST) -> dict[str, object]:
    """By their names in a script: the modules, functions and values of the package it imports."""
    found: dict[str, object] = {}
    for node in ast.walk(tree):
        names = getattr(node, "names", ())
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("montecarlo_brdf"):
            found |= {n.asname or n.name: member(str(node.module), n.name) for n in names}
        elif isinstance(node, ast.Import):
            ours = [n for n in names if n.name.startswith("montecarlo_brdf")]
            found |= {n.asname or n.name: importlib.import_module(n.name) for n in ours}
    return found


def member(module: str, name: str) -> object:
    """`from module import name`."""
    whole = importlib.import_module(module)
    if hasattr(whole, name):
        return getattr(whole, name)
    return importlib.import_module(f"{module}.{name}")


def missing(tree: ast.AST) -> Iterator[str]:
    """Members that a script expects of these modules and that they lack."""
    modules = {n: m for n, m in taken(tree).items() if isinstance(m, types.ModuleType)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            whole = modules.get(node.value.id)
            if whole is not None and not hasattr(whole, node.attr):
                yield f"{node.value.id}.{node.attr}"


@pytest.mark.parametrize("path", sorted(SCRIPTS.rglob("*.py")), ids=lambda path: path.stem)
def test_what_a_script_takes_of_the_package_is_there(path: Path) -> None:
    assert list(missing(ast.parse(path.read_text(encoding="utf-8")))) == []


def test_what_is_not_there_is_seen() -> None:
    text = "import montecarlo_brdf as mb\nfrom montecarlo_brdf import vectors\n"
    assert list(missing(ast.parse(text + "mb.load('x'); vectors.turned(mb.gone)"))) == [
        "vectors.turned",
        "mb.gone",
    ]
    with pytest.raises(ModuleNotFoundError):
        taken(ast.parse("from montecarlo_brdf.vectors import turned"))
