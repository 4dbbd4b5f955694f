"""The rules of the house, each with a small wrong example that it must see.

Strings never steer, parameters say their type, a constant is one thing, names in prose resolve,
tests are named after what they hold. The order of imports has a test of its own, test_imports.py.
"""
from __future__ import annotations

import ast
import importlib
import io
import re
import tokenize
from collections.abc import Iterable, Iterator
from enum import StrEnum
from pathlib import Path

import pytest

import montecarlo_brdf
from montecarlo_brdf.estimate.plan import Choice
from montecarlo_brdf.judge.claim import Kind
from montecarlo_brdf.judge.finding import Bound, Verdict
from montecarlo_brdf.model import Property
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import PointSet

PACKAGE = Path(montecarlo_brdf.__file__).parent
ROOT = PACKAGE.parent
SOURCES = {p: p.read_text(encoding="utf-8") for p in sorted(PACKAGE.rglob("*.py"))}
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]

# strings never steer ------------------------------------------------------------------------------

#: by what name a value of an enum goes -> the enums it may be of
STEERING: dict[str, tuple[type[StrEnum], ...]] = {
    "verdict": (Verdict,),
    "bound": (Bound,),
    "kind": (Kind,),
    "disclaimed": (Property,),
    "PROPERTY": (Property,),
    "sampler": (Sampler,),
    "chart": (Sampler,),
    "points": (PointSet,),
    "method": (Choice,),
}


def steered(source: str) -> list[str]:
    """Comparisons of a verdict, a sampler or another such thing with a word in quotes."""
    nodes = list(ast.walk(ast.parse(source)))
    compared = [(n, [n.left, *n.comparators]) for n in nodes if isinstance(n, ast.Compare)]
    asked = [(n, [n.func.value, *n.args]) for n in nodes if _asks_for_a_part(n)]
    matched = [(n, [n.subject, *_patterns(n)]) for n in nodes if isinstance(n, ast.Match)]
    return [ast.unparse(n) for n, sides in [*compared, *asked, *matched] if _by_word(sides)]


def _asks_for_a_part(node: ast.AST) -> bool:
    called = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
    return called and node.func.attr in ("startswith", "endswith")


def _patterns(node: ast.Match) -> Iterator[ast.expr]:
    inside = (p for case in node.cases for p in ast.walk(case.pattern))
    yield from (p.value for p in inside if isinstance(p, ast.MatchValue))


def _by_word(sides: list[ast.expr]) -> bool:
    """Whether one side is such a thing and another one of its words, or the beginning of one."""
    words = {w for side in sides for w in _words(side)}
    enums = [e for side in sides for e in STEERING.get(_name(side), ())]
    return any(str(m).startswith(w) for e in enums for m in e for w in words if w)


def _words(side: ast.expr) -> Iterator[str]:
    parts = side.elts if isinstance(side, ast.Tuple | ast.List | ast.Set) else [side]
    yield from (p.value for p in parts if isinstance(p, ast.Constant) and isinstance(p.value, str))


def _name(side: ast.expr) -> str:
    """`kind` of `one.kind`, `kind` and `one.kind.value`."""
    if isinstance(side, ast.Attribute):
        return _name(side.value) if side.attr in ("value", "name") else side.attr
    return side.id if isinstance(side, ast.Name) else ""


def test_no_word_in_quotes_stands_for_a_value_of_an_enum() -> None:
    assert [(p.name, found) for p, source in SOURCES.items() if (found := steered(source))] == []


@pytest.mark.parametrize(
    "source",
    [
        "finding.verdict == 'fail'",
        "'pass' != verdict",
        "bound in ('at most', 'at least')",
        "claim.expected.kind.startswith('quadrature')",
        "sampler.value == 'own'",
        "plan.method == 'auto'",
        "match sampler:\n    case 'own':\n        pass",
    ],
)
def test_words_that_steer_are_seen(source: str) -> None:
    assert steered(source)


@pytest.mark.parametrize("source", ["verdict is Verdict.FAIL", "key in ('pdf', 'sample')"])
def test_other_words_are_none_of_this(source: str) -> None:
    assert not steered(source)


# parameters say their type ------------------------------------------------------------------------

Function = ast.FunctionDef | ast.AsyncFunctionDef
ALLOWED = 0.05


def aliases(sources: Iterable[str]) -> set[str]:
    """Names that stand for Any."""
    nodes = [n for source in sources for n in ast.parse(source).body]
    plain = [n for n in nodes if isinstance(n, ast.Assign) and ast.unparse(n.value) == "Any"]
    return {"Any", *(t.id for n in plain for t in n.targets if isinstance(t, ast.Name))}


def typed(source: str, untyped: set[str]) -> Iterator[bool]:
    """Of every parameter whether its type says something."""
    for node in ast.walk(ast.parse(source)):
        for parameter in _parameters(node):
            note = parameter.annotation
            yield note is not None and ast.unparse(note) not in untyped


def _parameters(node: ast.AST) -> list[ast.arg]:
    if not isinstance(node, Function):
        return []
    a = node.args
    found = [*a.posonlyargs, *a.args, *a.kwonlyargs, *filter(None, (a.vararg, a.kwarg))]
    return [p for p in found if p.arg not in ("self", "cls")]


def test_parameters_say_their_type() -> None:
    untyped = aliases(SOURCES.values())
    found = [one for source in SOURCES.values() for one in typed(source, untyped)]
    assert found.count(False) <= ALLOWED * len(found)


def test_what_counts_as_a_type() -> None:
    source = "Thing = Any\ndef f(a: int, b: Any, c, *d: Thing, e: list[Any]): pass"
    assert list(typed(source, aliases([source]))) == [True, False, False, True, False]


# a name is one thing ------------------------------------------------------------------------------


def bound_twice(source: str) -> list[str]:
    """Constants of a module that are bound more than once: the first reader gets the last value."""
    nodes = ast.parse(source).body
    targets = [t for n in nodes if isinstance(n, ast.Assign) for t in n.targets]
    targets += [n.target for n in nodes if isinstance(n, ast.AnnAssign)]
    names = [n.id for t in targets for n in ast.walk(t) if isinstance(n, ast.Name)]
    return sorted({n for n in names if names.count(n) > 1 and n.isupper()})


def test_no_constant_is_bound_twice() -> None:
    found = {p.name: bound_twice(source) for p, source in SOURCES.items()}
    assert {name: twice for name, twice in found.items() if twice} == {}


def test_constants_bound_twice_are_seen() -> None:
    assert bound_twice("FALL, MOST = 32.0, 20\nAT, FALL = 1, 3\nMOST_OF: int = 5") == ["FALL"]


# names in prose resolve ---------------------------------------------------------------------------

#: `judge.decide`, `estimate.trust.few_carry(...)`, `montecarlo_brdf.run`
DOTTED = re.compile(r"`(?:montecarlo_brdf\.)?([a-z_]\w*(?:\.\w+)+)(?:\([^`]*\))?`")
EXAMPLE = "/soft.py"  # what CONTRIBUTING.md writes
FILE = re.compile(r"(?<![\w./<-])((?:\w+/)+[\w-]+\.(?:py|md|toml|json|png|svg))\b")
PAGE = re.compile(r"\b([\w-]+\.(?:md|pdf|rst))\b")
PARTS = {p.stem for p in PACKAGE.iterdir() if p.suffix == ".py" or p.is_dir()}
FOLDERS = {p.name for place in (ROOT, PACKAGE) for p in place.iterdir() if p.is_dir()}


def prose(source: str) -> Iterator[str]:
    """Docstrings and comments."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | Function):
            yield ast.get_docstring(node) or ""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    yield from (t.string for t in tokens if t.type == tokenize.COMMENT)


def unresolved(text: str) -> list[str]:
    """Dotted names of the package, files and pages that a text mentions and that do not exist."""
    names = [n for n in DOTTED.findall(text) if n.split(".")[0] in PARTS and not _resolves(n)]
    files = [f for f in FILE.findall(text) if f.split("/")[0] in FOLDERS and not _exists(f)]
    return [*names, *files, *(p for p in PAGE.findall(text) if p not in _pages())]


def _resolves(name: str) -> bool:
    parts = name.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(("montecarlo_brdf", *parts[:k])))
        except ModuleNotFoundError:
            continue
        instance = getattr(found, parts[k - 1].capitalize(), None)  # a `model` is a `Model`
        return _has(found, parts[k:]) or _has(instance, parts[k:])
    return False


def _has(found: object, names: list[str]) -> bool:
    for name in names:
        fields = getattr(found, "__annotations__", {})
        if not hasattr(found, name):
            return name in fields
        found = getattr(found, name)
    return True


def _exists(file: str) -> bool:
    return file.endswith(EXAMPLE) or any((place / file).exists() for place in (ROOT, PACKAGE))


def _pages() -> set[str]:
    places = (ROOT, ROOT / "docs", ROOT / "scripts" / "results")
    return {p.name for place in places for p in place.glob("*.*")}


def test_names_and_files_in_docstrings_exist() -> None:
    texts = [(p.name, text) for p, source in SOURCES.items() for text in prose(source)]
    assert [(file, found) for file, text in texts if (found := unresolved(text))] == []


def test_names_and_files_in_pages_exist() -> None:
    texts = {p.name: p.read_text(encoding="utf-8") for p in PAGES}
    assert [(file, found) for file, text in texts.items() if (found := unresolved(text))] == []


@pytest.mark.parametrize(
    "text",
    [
        "decided by `judge.nobody`",
        "see `compile.kernel.Kernel.pacing`",
        "see compile/jit.py",
        "Source: formulas.md, section 6",
    ],
)
def test_names_that_do_not_exist_are_seen(text: str) -> None:
    assert unresolved(text)


def test_names_that_exist_are_not() -> None:
    text = "`judge.decide`, `compile.kernel.Kernel.key`, compile/kernel.py, docs/models.md, my.py"
    assert unresolved(text) == []


# tests are named after what they hold -------------------------------------------------------------

#: words of a day on which something went wrong
INCIDENTS = {
    "audit", "bug", "bugs", "fix", "fixes", "incident", "issue", "misc", "more", "new", "old",
    "regression", "review", "round", "seen", "trial", "user",
}  # fmt: skip


def incident(path: Path) -> bool:
    """Whether a test file is named after an incident."""
    words = set(path.stem.removeprefix("test_").split("_"))
    return bool(words & INCIDENTS) and words != {"user", "functions"}


def test_no_test_is_named_after_an_incident() -> None:
    assert [p.name for p in (ROOT / "tests").rglob("test_*.py") if incident(p)] == []


@pytest.mark.parametrize("name", ["test_user_trial.py", "test_seen_by_draws.py", "test_fix_12.py"])
def test_incidents_are_seen(name: str) -> None:
    assert incident(Path(name))
