"""The order of imports is the way data flows; this walks the source and keeps it true."""
from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import montecarlo_brdf

PACKAGE = Path(montecarlo_brdf.__file__).parent
NAME = PACKAGE.name

#: A part may import itself, what stands before it in its row, and errors.
FLOW = (
    ("errors",),
    ("bits", "files", "special", "toml", "vectors"),
    ("chi_squared", "compile", "statistics"),
    ("sampling",),
    ("contract", "counterpart", "foreign", "loading", "measured", "mixture", "model", "models",
     "reading"),  # fmt: skip
    ("arithmetic",),
    ("estimate",),
    ("cases",),
    ("judge",),
    ("truth",),
    ("checks",),
    ("diagnosis", "scene", "stability", "table"),
    ("report",),
    ("verify",),
    ("sweep",),
    ("cli",),
    ("testing",),
    ("pytest_plugin",),
    ("__main__",),
)
RANK = {part: rank for rank, row in enumerate(FLOW) for part in row}
#: Imported by those who compare with the truth, and importing nothing of the package.
REFERENCES = "references"
COMPARE = ("checks", "cli", "scene", "truth")
#: What a model may use: a user's own file has exactly the form of a built-in one.
FOR_MODELS = {"bits", "models", "sampling.warps", "special", "vectors"}
#: What a report is made from; a picture or a text needs nothing else.
FOR_REPORTS = ("errors.", "judge.diagnosis.", "judge.finding.", "report.")
#: package -> where it may be imported
KEPT_IN = {
    "click": ("cli/",),
    "matplotlib": ("report/",),
    "numba": ("compile/",),
    "llvmlite": ("compile/",),
}
#: Slow to import: never at the top of a file, so that --help stays instant.
LATE = ("numba", "llvmlite", "scipy", "matplotlib")


def files() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


def place(path: Path) -> str:
    return path.relative_to(PACKAGE).as_posix()


def part_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(tree: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """Dotted names that a file imports; of `from a import b` both a and a.b."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative import"
            yield str(node.module), node
            yield from ((f"{node.module}.{alias.name}", node) for alias in node.names)


def inside(tree: ast.AST) -> set[ast.AST]:
    """Nodes that run only when a function is called or a type checker looks."""
    late = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
    return {n for f in ast.walk(tree) if isinstance(f, late) or _typing(f) for n in ast.walk(f)}


def _typing(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def own(tree: ast.AST) -> set[str]:
    """Modules and names of the package that a file imports, without the package's name."""
    dotted = {n for n, _ in imported(tree)}
    return {n.removeprefix(f"{NAME}.") for n in dotted if n.startswith(f"{NAME}.")}


def faults(path: str, source: str) -> list[str]:
    """What is wrong with the imports of a file at `path` within the package."""
    tree = ast.parse(source)
    part = path.split("/")[0].removesuffix(".py")
    given = [*not_for_models(path, tree), *not_for_reports(path, tree)]
    return [*wrong_way(part, tree), *given, *misplaced(path, tree)]


def wrong_way(part: str, tree: ast.AST) -> Iterator[str]:
    for name in own(tree):
        used = name.split(".")[0]
        if used not in RANK and used != REFERENCES:
            continue  # a name of montecarlo_brdf/__init__, as __version__
        if part == REFERENCES:
            allowed = used == REFERENCES
        elif used == REFERENCES:
            allowed = part in COMPARE
        else:
            allowed = part == used or used == "errors" or RANK[used] <= RANK.get(part, -1)
        if not allowed:
            yield f"{part} imports {name}"


def not_for_models(path: str, tree: ast.AST) -> Iterator[str]:
    if path.startswith("models/"):
        for name in own(tree):
            if not any(name == a or name.startswith(a + ".") for a in FOR_MODELS | {"sampling"}):
                yield f"a model imports {name}"
            if name.startswith("sampling.") and not name.startswith("sampling.warps"):
                yield f"a model imports {name}"


def not_for_reports(path: str, tree: ast.AST) -> Iterator[str]:
    if path.startswith("report/"):
        for name in own(tree):
            if name != "judge" and not f"{name}.".startswith(FOR_REPORTS):
                yield f"a report imports {name}"


def misplaced(path: str, tree: ast.AST) -> Iterator[str]:
    late = inside(tree)
    for name, node in imported(tree):
        outer = name.split(".")[0]
        if outer in KEPT_IN and not path.startswith(KEPT_IN[outer]):
            yield f"{path} imports {outer}"
        if outer in LATE and node not in late:
            yield f"{path} imports {outer} at its top"


@pytest.mark.parametrize("path", files(), ids=place)
def test_imports_follow_the_flow_of_data(path: Path) -> None:
    assert faults(place(path), path.read_text(encoding="utf-8")) == []


def test_every_part_has_its_place() -> None:
    assert {part_of(p) for p in files()} == {*RANK, REFERENCES, "__init__"}


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("models/wrong.py", "from montecarlo_brdf.compile import kernel"),
        ("models/wrong.py", "from montecarlo_brdf.sampling import points"),
        ("models/wrong.py", "from montecarlo_brdf.errors import UserError"),
        ("references/wrong.py", "from montecarlo_brdf.vectors import dot"),
        ("references/wrong.py", "import montecarlo_brdf.models.ggx"),
        ("checks/wrong.py", "from montecarlo_brdf import report"),
        ("estimate/wrong.py", "from montecarlo_brdf.references import albedo"),
        ("vectors.py", "def f():\n    from montecarlo_brdf.sampling import warps"),
        ("report/wrong.py", "import click"),
        ("report/wrong.py", "from montecarlo_brdf import statistics"),
        ("report/wrong.py", "from montecarlo_brdf.judge import claim"),
        ("verify/wrong.py", "def f():\n    import matplotlib.pyplot"),
        ("compile/wrong.py", "import numba"),
        ("checks/wrong.py", "def f():\n    import numba"),
        ("references/wrong.py", "import scipy.special"),
    ],
)
def test_wrong_imports_are_seen(path: str, source: str) -> None:
    assert faults(path, source)
